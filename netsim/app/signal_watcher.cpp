#include "netsim/app/signal_watcher.h"

#include <poll.h>

#include <cstdio>

#include "common/io/print.h"
#include "common/io/signals.h"

namespace tandem::netsim {

SignalWatcher::SignalWatcher() : signals_(io::make_signalfd()) {}

bool SignalWatcher::signalled() const noexcept {
  pollfd waiting{signals_.get(), POLLIN, 0};
  return ::poll(&waiting, 1, 0) > 0;
}

void SignalWatcher::report(std::string_view command, const std::string& done) {
  const std::string_view by = io::pending_signal();
  io::print_formatted(
      stderr,
      "tandem-netsim %.*s: interrupted after %s%s%.*s. The results so far are reported and do not count as a pass\n",
      static_cast<int>(command.size()), command.data(), done.c_str(), by.empty() ? "" : " by ",
      static_cast<int>(by.size()), by.data());
}

}  // namespace tandem::netsim
