#pragma once

#include <array>

#include "common/base/axes.h"
#include "proto/wire/session_telemetry.h"

namespace tandem::console {

/// Velocities of a session's tools from the difference of two telemetries: TELEMETRY has positions only.
class ToolVelocities {
 public:
  static constexpr double kSpanMin = 0.004, kSpanMax = 0.2;  ///< between the two [s], by the session's clock
  using Velocity = std::array<double, 3>;                    ///< [m/s], frame of the scene; NaN: not known

  [[nodiscard]] static constexpr std::array<Velocity, kToolsMax> unknown() noexcept {
    std::array<Velocity, kToolsMax> v{};
    v.fill({wire::kUnknown, wire::kUnknown, wire::kUnknown});
    return v;
  }
  /// @param tick_hz  of the session [1/s]
  /// @return velocity of each tool; NaN for the first telemetry, after a gap, and while the session's clock stands
  /// still
  [[nodiscard]] const std::array<Velocity, kToolsMax>& update(const wire::SessionTelemetry& newest, double tick_hz);

 private:
  std::array<Velocity, kToolsMax> v_ = unknown();
  std::array<Velocity, kToolsMax> x_{};  ///< positions at `tick_` [m]
  std::uint32_t tick_ = 0;
  bool known_ = false;
};

}  // namespace tandem::console
