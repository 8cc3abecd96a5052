#pragma once

#include "hal/core/device.h"
#include "hal/sim/environment.h"
#include "hal/sim/hand.h"
#include "hal/sim/touch_kinematics.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// Longest step of a plant's integrator [s].
inline constexpr double kSubstepMax = 0.25e-3;
/// Tip speed over which Coulomb friction is smoothed [m/s].
inline constexpr double kFrictionSpeed = 1e-3;

/// Dynamics of the simulated Touch with a hand and an environment at its tip:
///   (M(q) + m_h J^T J) ddq + C(q, dq) dq + G(q) + friction + J^T b J dq = tau + J^T (F_hand + F_environment).
/// Scheme: midpoint pose, linearly implicit; stable for any stiffness, damping and friction.
/// - Springs are trapezoidal (they conserve energy).
/// - Viscous and Coulomb damping are backward Euler (secant damping tau_c / sqrt(dq^2 + v_s^2)).
/// - Contacts: see environment.h.
/// J^T J has the same 1 + 2 block pattern as M, so one closed-form inverse covers everything isotropic at the tip.
/// Contacts are rank-one updates of it.
/// Deterministic, no heap, total: efforts are limited to 10 N m, forces to 1 kN, speeds to 200 rad/s.
class TouchPlant {
 public:
  static constexpr bool kPrismatic = false;
  static constexpr std::size_t kJoints = 3;

  /// @param q0  joint angles at the start [rad], at rest
  TouchPlant(const SimDeviceSpec& spec, const EnvironmentSpec& environment, const Vec3& q0) noexcept;

  /// Advances by `dt` [s] under the joint effort `tau` [N m]; non-finite entries count as 0.
  void advance(const Vec3& tau, const HandPull& hand, double dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] const Vec3& q() const noexcept { return q_; }
  [[nodiscard]] const Vec3& dq() const noexcept { return dq_; }
  [[nodiscard]] const TouchPose& pose() const noexcept { return pose_; }  ///< at q
  [[nodiscard]] Vec3 tip() const noexcept { return pose_.tip(); }
  [[nodiscard]] Vec3 tip_velocity() const noexcept { return pose_.tip_velocity(dq_); }
  [[nodiscard]] const Vec3& environment_force() const noexcept {
    return f_environment_;
  }  ///< on the tip, mean of the last advance [N]
  [[nodiscard]] const Vec3& hand_force() const noexcept { return f_hand_; }  ///< likewise, without inertia [N]
  [[nodiscard]] double penetration() const noexcept { return environment_.penetration(tip()); }

  /// Energies of the device without the hand [J].
  [[nodiscard]] double kinetic_energy() const noexcept;
  [[nodiscard]] double potential_energy() const noexcept;
  /// Returns the device inertia [kg m^2] at a pose, without the hand.
  [[nodiscard]] static Eigen::Matrix3d inertia(const TouchPose& pose) noexcept;
  /// Returns the joint effort that balances gravity [N m].
  [[nodiscard]] static Vec3 gravity(const TouchPose& pose) noexcept;
  /// Returns the Coulomb friction of the joints [N m] that corresponds to `friction` [N] at the tip.
  /// It is `friction` times the lever arm of each joint, with the tip at the vendor's origin.
  [[nodiscard]] static Vec3 joint_friction(double friction) noexcept;
  /// Returns the lever arms |J column| at the working pose [m].
  [[nodiscard]] static Vec3 working_levers() noexcept;

  /// Returns whether a pose is within the mechanical stops.
  [[nodiscard]] static bool within_stops(const Vec3& q) noexcept;

  /// For tests: sets joint angles [rad] and rates [rad/s].
  void set(const Vec3& q, const Vec3& dq) noexcept;

 private:
  void substep(const Vec3& tau, const HandPull& hand, const Vec3& intended, double h) noexcept;

  Environment environment_;
  Vec3 friction_;          ///< Coulomb, per joint [N m]
  Vec3 friction_rate2_;    ///< smoothing speed squared, per joint [rad^2/s^2]
  double damping_, load_;  ///< [N s/m], mass at the tip [kg]
  bool gravity_;
  Vec3 q_;
  Vec3 dq_ = Vec3::Zero();
  Vec3 dq_prev_ = Vec3::Zero();
  TouchPose pose_;
  Vec3 f_environment_ = Vec3::Zero();
  Vec3 f_hand_ = Vec3::Zero();
};

}  // namespace tandem::hal::sim
