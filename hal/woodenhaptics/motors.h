#pragma once

#include <array>
#include <cstdint>

#include "hal/device.h"
#include "proto/woodenhaptics_spec.h"

namespace tandem::hal::woodenhaptics {

/// What is sent to the board for a joint effort, and what the motors make of it.
struct MotorOrder {
  std::array<std::int16_t, 3> current_ma{};  ///< as the firmware understands milliamperes
  Vec3 effort = Vec3::Zero();  ///< joint effort of these integers without what holds the arms [N m]
  bool saturated = false;      ///< less than was asked for, by more than rounding
};

/// Joint effort [N m] to integer currents: motor torque = effort * capstan / body, current = torque / k_t. Currents are
/// clamped before they become integers, keeping the direction of the effort, so nothing wraps and no motor gets more
/// than `current_max`, nor more than the firmware's full scale. Total: what is not finite counts as 0.
class Motors {
 public:
  explicit Motors(const WoodenHapticsSpec& spec) noexcept;

  /// @param effort   asked by the host [N m]
  /// @param holding  on top of it, to carry the arms [N m]; has precedence
  [[nodiscard]] MotorOrder order(const Vec3& effort, const Vec3& holding) const noexcept TANDEM_REALTIME;
  /// Joint effort of integers on the wire [N m].
  [[nodiscard]] Vec3 effort_of(const std::array<std::int16_t, 3>& current_ma) const noexcept TANDEM_REALTIME;
  /// Real current of one motor for a joint effort, signed [A/(N m)].
  [[nodiscard]] const Vec3& current_per_effort() const noexcept { return current_per_effort_; }
  [[nodiscard]] int limit_ma() const noexcept { return limit_ma_; }

 private:
  Vec3 current_per_effort_;
  double wire_per_ampere_;  ///< milliamperes on the wire for one real ampere
  int limit_ma_;            ///< on the wire
};

}  // namespace tandem::hal::woodenhaptics
