#pragma once

#include <atomic>

#include "common/base/time.h"

namespace tandem::server {

/// Time from which no session of this server may act, for all that it owns in a service. One thread sets it; the ticks
/// of all sessions read it, so that no other thread has to run between the two.
class ActLimit {
 public:
  /// @param until  of CLOCK_BOOTTIME
  void set(Time until) noexcept { until_.store(until, std::memory_order_relaxed); }
  [[nodiscard]] Time until() const noexcept { return until_.load(std::memory_order_relaxed); }

 private:
  std::atomic<Time> until_{Time{}};
  static_assert(std::atomic<Time>::is_always_lock_free);
};

}  // namespace tandem::server
