#pragma once

#include <array>
#include <cstdint>

#include "hal/core/device.h"
#include "proto/spec/woodenhaptics_spec.h"

namespace tandem::hal::woodenhaptics {

/// Currents sent to the board for a joint effort, and the effort they produce.
struct MotorCommand {
  std::array<std::int16_t, 3> current_ma{};  ///< in the firmware's milliamperes
  Vec3 effort = Vec3::Zero();  ///< joint effort of these integer currents, without the gravity compensation [N m]
  bool saturated = false;      ///< less than commanded, by more than rounding
};

/// Conversion of joint effort [N m] to integer currents: motor torque = effort * capstan / body, current = torque /
/// k_t.
/// Currents are clamped before the conversion to integers, keeping the direction of the effort, so no value wraps.
/// No motor gets more than `current_max` or the firmware's full scale. Total: non-finite values count as 0.
class Motors {
 public:
  explicit Motors(const WoodenHapticsSpec& spec) noexcept;

  /// Returns the currents for a joint effort.
  /// @param effort   commanded by the host [N m]
  /// @param holding  additional gravity compensation [N m]; has precedence
  [[nodiscard]] MotorCommand to_command(const Vec3& effort, const Vec3& holding) const noexcept TANDEM_REALTIME;
  /// Returns the joint effort of the integer currents of a report [N m].
  [[nodiscard]] Vec3 effort_of(const std::array<std::int16_t, 3>& current_ma) const noexcept TANDEM_REALTIME;
  /// Returns the physical current of each motor per joint effort, signed [A/(N m)].
  [[nodiscard]] const Vec3& current_per_effort() const noexcept { return current_per_effort_; }
  [[nodiscard]] int limit_ma() const noexcept { return limit_ma_; }

 private:
  Vec3 current_per_effort_;
  double wire_per_ampere_;  ///< milliamperes in the report per physical ampere
  int limit_ma_;            ///< in the report's unit
};

}  // namespace tandem::hal::woodenhaptics
