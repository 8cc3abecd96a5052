#pragma once

#include <csignal>
#include <thread>
#include <utility>

namespace tandem::io {

/// Starts a thread with all signals blocked, so that signals reach other threads only.
template <class Body>
[[nodiscard]] std::thread thread_without_signals(Body&& body) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread started(std::forward<Body>(body));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return started;
}

}  // namespace tandem::io
