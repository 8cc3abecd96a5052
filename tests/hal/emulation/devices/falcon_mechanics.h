#pragma once

#include <array>
#include <cstdint>

#include "hal/core/device.h"
#include "hal/drivers/falcon/falcon_frame.h"
#include "hal/drivers/falcon/falcon_kinematics.h"
#include "hal/sim/hand.h"

namespace tandem::hal::emulation {

struct FalconMechanicsSpec {
  double mass = 0.15;       ///< at the tip [kg]; assumed
  double damping = 1.0;     ///< at the tip [N s/m]; assumed
  double friction = 0;      ///< Coulomb, of the tip [N], smoothed over 1 mm/s
  double load = 0;          ///< mass hung on the grip [kg]; only this mass has weight
  Vec3 up = Vec3::UnitZ();  ///< direction against gravity, length 1: a Falcon may lie on its back
  std::array<double, 3> counts_per_nm{10000, 10000, 10000};  ///< true scale of the motors
  Vec3 start = Vec3::Zero();                                 ///< tip [m]
};

/// Tip of a Falcon as one mass, moved by its motors and a hand within the mechanism's reach.
/// Encoders count from the tip's position at power-up until each leg has found its origin.
/// Implicit in the hand's spring and the dampers: stable for all of them.
class FalconMechanics {
 public:
  explicit FalconMechanics(const FalconMechanicsSpec& spec) noexcept;

  /// @param dt  step [s], at most 1 ms; a shorter step is more accurate
  void advance(const std::array<std::int16_t, 3>& motor, double dt) noexcept;
  /// Sets the force law of the hand; its intended position advances with its velocity.
  void set_pull(const sim::HandPull& pull) noexcept { pull_ = pull; }
  void set_load(double mass) noexcept { spec_.load = mass; }
  /// Resets all origins, as at power-up.
  void lose_origin() noexcept;
  /// Sets the origin of leg `i`: its counts follow its true angle from now on.
  void find_origin(std::size_t i) noexcept { offset_[i] = 0; }

  [[nodiscard]] const Vec3& tip() const noexcept { return pose_.x; }
  [[nodiscard]] const Vec3& velocity() const noexcept { return v_; }
  [[nodiscard]] const Vec3& theta() const noexcept { return theta_; }
  /// Returns the force of the motors on the tip [N].
  [[nodiscard]] const Vec3& motor_force() const noexcept { return motor_force_; }
  [[nodiscard]] std::array<std::int16_t, 3> encoder() const noexcept;

 private:
  [[nodiscard]] std::array<std::int32_t, 3> true_counts() const noexcept;

  FalconMechanicsSpec spec_;
  FalconPose pose_;
  Vec3 theta_ = Vec3::Zero();
  Vec3 v_ = Vec3::Zero();
  Vec3 motor_force_ = Vec3::Zero();
  sim::HandPull pull_;
  std::array<std::int32_t, 3> offset_{};
};

}  // namespace tandem::hal::emulation
