#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Decides which STATEs of a seat carry telemetry: all while the server records the session, else at most
/// wire::kTelemetryHz per second.
class TelemetryPace {
 public:
  /// @param tick_hz  rate of ticks [Hz], above 0
  /// @param early    ticks by which a STATE may carry telemetry before it is due
  explicit TelemetryPace(double tick_hz, std::uint32_t early = 0) noexcept
      : interval_(static_cast<std::uint32_t>(std::ceil(tick_hz / wire::kTelemetryHz))) {
    interval_ -= std::min(early, interval_ - 1);
  }

  /// Whether the STATE of this tick carries telemetry; a true result counts as carried.
  /// @param tick   number of the tick; may skip numbers
  /// @param every  the server asks for telemetry at every tick
  [[nodiscard]] bool due(std::uint32_t tick, bool every) noexcept {
    if (!every && begun_ && tick - last_ < interval_) return false;
    last_ = tick;
    begun_ = true;
    return true;
  }
  /// The next STATE carries telemetry: a new connection knows none.
  void restart() noexcept { begun_ = false; }

 private:
  std::uint32_t interval_;  ///< ticks
  std::uint32_t last_ = 0;
  bool begun_ = false;
};

}  // namespace tandem::client
