#pragma once

#include <poll.h>

#include <functional>

#include "common/base/time.h"
#include "common/io/clock.h"

namespace tandem::client {

/// Waits until `done`, which is asked every 20 ms, at most for `limit`.
/// @param signals  signalfd (common/io/signals.h)  @return false if a signal arrived
[[nodiscard]] inline bool wait_unless_interrupted(Duration limit, int signals, const std::function<bool()>& done) {
  constexpr int kPollMs = 20;
  const Time end = io::monotonic_now() + limit;
  while (io::monotonic_now() < end && !done()) {
    pollfd file{signals, POLLIN, 0};
    if (poll(&file, 1, kPollMs) > 0) return false;
  }
  return true;
}

}  // namespace tandem::client
