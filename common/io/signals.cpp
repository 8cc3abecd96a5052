#include "common/io/signals.h"

#include <pthread.h>
#include <sys/signalfd.h>

#include <csignal>

namespace tandem::io {

Fd make_signalfd() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a closed reader of standard output must not end a session
  return Fd{signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK)};
}

std::string_view pending_signal() noexcept {
  sigset_t pending;
  if (sigpending(&pending) != 0) return {};
  if (sigismember(&pending, SIGTERM) == 1) return "SIGTERM";
  if (sigismember(&pending, SIGHUP) == 1) return "SIGHUP (its terminal is gone)";
  return sigismember(&pending, SIGINT) == 1 ? "Ctrl-C" : std::string_view{};
}

}  // namespace tandem::io
