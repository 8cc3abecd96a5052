#pragma once

#include "hal/core/device.h"
#include "hal/sim/environment.h"
#include "hal/sim/hand.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// A mass on a rail along x, with the same hand, environment, friction and integrator as TouchPlant; y and z stay at
/// the start.
///   (m + m_h) ddx + friction + b dx = f + F_hand + F_environment.
/// Deterministic, no heap, total: forces are limited to 1 kN, the position to +-10 m.
class LinearPlant {
 public:
  static constexpr bool kPrismatic = true;
  static constexpr std::size_t kJoints = 1;

  LinearPlant(const SimDeviceSpec& spec, const EnvironmentSpec& environment, const Vec3& start) noexcept;

  /// Advances by `dt` [s] under the force `tau[0]` [N]; a non-finite force counts as 0.
  void advance(const Vec3& tau, const HandPull& hand, double dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] Vec3 q() const noexcept { return {tip_[0], 0.0, 0.0}; }
  [[nodiscard]] Vec3 dq() const noexcept { return {v_, 0.0, 0.0}; }
  [[nodiscard]] const Vec3& tip() const noexcept { return tip_; }
  [[nodiscard]] Vec3 tip_velocity() const noexcept { return {v_, 0.0, 0.0}; }
  [[nodiscard]] const Vec3& environment_force() const noexcept { return f_environment_; }
  [[nodiscard]] const Vec3& hand_force() const noexcept { return f_hand_; }
  [[nodiscard]] double penetration() const noexcept;
  [[nodiscard]] double kinetic_energy() const noexcept { return 0.5 * mass_ * v_ * v_; }
  /// For tests: sets position [m] and velocity [m/s].
  void set(double x, double v) noexcept;

 private:
  void substep(double force, const HandPull& hand, double intended, double h) noexcept;

  Environment environment_;
  double mass_, friction_, damping_;
  Vec3 tip_;
  double v_ = 0;
  Vec3 f_environment_ = Vec3::Zero();
  Vec3 f_hand_ = Vec3::Zero();
};

}  // namespace tandem::hal::sim
