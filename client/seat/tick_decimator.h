#pragma once

#include "common/base/time.h"

namespace tandem::client {

/// Selects the device exchanges that are ticks of the seat. A device with a higher rate than the scene exchanges
/// several times per tick; the seat then ticks in the exchange nearest to each tick time. Missed ticks are not
/// repeated.
class TickDecimator {
 public:
  /// @param tick      tick period of the scene
  /// @param exchange  exchange period of the device. If it is zero or more than half a tick, every exchange is a tick,
  ///                  however irregular the exchanges are.
  TickDecimator(Duration tick, Duration exchange) noexcept
      : tick_(tick), exchange_(2 * exchange > tick ? Duration::zero() : exchange) {}

  /// Returns whether every exchange is a tick.
  [[nodiscard]] bool takes_all() const noexcept { return exchange_ == Duration::zero(); }
  /// @param now  time of an exchange, ascending  @return true if this exchange is a tick
  [[nodiscard]] bool due(Time now) noexcept {
    if (takes_all()) return true;
    if (begun_ && now < due_ - exchange_ / 2) return false;
    due_ = (begun_ && now < due_ + tick_ ? due_ : now) + tick_;
    begun_ = true;
    return true;
  }

 private:
  Duration tick_, exchange_;
  Time due_{};  ///< time of the next tick
  bool begun_ = false;
};

}  // namespace tandem::client
