#pragma once

#include <cstdint>
#include <optional>

namespace tandem {

/// Changes that a participant does not notice, as shares of the present value (common/control/send_pace.h).
struct DeadBandSpec {
  double weber = 0.1;           ///< Weber fraction [1]
  double velocity_floor = 0.1;  ///< the share is never of less than this velocity of the hand [m/s]
  double force_floor = 0.6;     ///< the share is never of less than this force on the hand [N]
};

/// When masters send STATE, and the server sends FORCE to them. Default: at every tick.
struct SendSpec {
  double rate = 0;                        ///< largest rate of datagrams [Hz]; 0: one per tick
  std::optional<DeadBandSpec> dead_band;  ///< empty: a datagram is sent whenever `rate` allows
  double heartbeat = 0;                   ///< longest time between two datagrams [s]; 0: the default, heartbeat_max
  std::uint32_t prediction_order = 1;     ///< prediction of values that are not sent: 0 holds, 1 extrapolates linearly
  /// Whether some ticks have no datagram.
  [[nodiscard]] bool is_on() const noexcept { return rate > 0 || dead_band; }
};

}  // namespace tandem
