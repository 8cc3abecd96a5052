#pragma once

#include "common/base/time.h"

namespace tandem::client {

/// Which exchanges of a device are ticks of its seat. A device with a rate of its own exchanges more often than the scene ticks: the seat
/// works in the exchange nearest to each of its ticks. Ticks that were slept through are not made up for.
class TickPace {
 public:
  /// @param tick      of the scene  @param exchange  of the device; zero, or so long that a tick has no second one: every exchange is a tick,
  ///                  however irregularly they come
  TickPace(Duration tick, Duration exchange) noexcept : tick_(tick), exchange_(2 * exchange > tick ? Duration::zero() : exchange) {}

  /// @param now  of an exchange, ascending  @return whether it is a tick
  [[nodiscard]] bool due(Time now) noexcept {
    if (exchange_ == Duration::zero()) return true;
    if (begun_ && now < due_ - exchange_ / 2) return false;
    due_ = (begun_ && now < due_ + tick_ ? due_ : now) + tick_;
    begun_ = true;
    return true;
  }

 private:
  Duration tick_, exchange_;
  Time due_{};  ///< the next tick
  bool begun_ = false;
};

}  // namespace tandem::client
