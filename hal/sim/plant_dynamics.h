#pragma once

#include <Eigen/Core>

#include "hal/core/device.h"
#include "hal/sim/environment.h"
#include "hal/sim/hand.h"
#include "proto/spec/scene_spec.h"

/// Equations of the simulated devices in continuous time, for the integrators of plant_step.h. LinearPlant and
/// TouchPlant have the same equations, discretised by a scheme of their own.
namespace tandem::hal::sim {

/// A body at one state. S is the type of all numbers.
template <class S, int N>
struct Forces {
  using Vector = Eigen::Matrix<S, N, 1>;
  using Matrix = Eigen::Matrix<S, N, N>;
  Matrix m = Matrix::Identity();  ///< inertia, positive definite [kg or kg m^2]
  Matrix k = Matrix::Zero();      ///< -df/dq of the springs, symmetric, not negative
  Matrix b = Matrix::Zero();      ///< of the dampers, symmetric, not negative: -df/dv, of friction -f/v
  Vector f = Vector::Zero();      ///< sum of all forces [N or N m]
  Eigen::Matrix<S, 3, 1> environment = Eigen::Matrix<S, 3, 1>::Zero();  ///< of the surfaces on the tip [N]
  Eigen::Matrix<S, 3, 1> hand = Eigen::Matrix<S, 3, 1>::Zero();         ///< of the hand on the tip [N]
};

/// Everything that acts on a plant during one `advance`.
struct PlantDrive {
  Vec3 tau = Vec3::Zero();  ///< effort of the motors, limited [N or N m]
  HandPull hand;
  double length = 0;  ///< of the period [s]; the hand's position is that of its middle
};

/// One axis: (m + m_h) x'' = tau - friction - b x' + F_hand + F_environment.
struct LinearDynamics {
  static constexpr bool kPrismatic = true;
  static constexpr int kJoints = 1;
  using Q = Eigen::Matrix<double, 1, 1>;

  LinearDynamics(const SimDeviceSpec& spec, const EnvironmentSpec& surfaces, const Vec3& start) noexcept;

  /// Returns the forces at position `q` [m] and velocity `v` [m/s], `t` [s] after the begin of the period.
  /// S is float, double, or long double for references.
  template <class S>
  [[nodiscard]] Forces<S, 1> forces(const Eigen::Matrix<S, 1, 1>& q, const Eigen::Matrix<S, 1, 1>& v,
                                    const PlantDrive& drive, S t) const noexcept;
  /// Limits position and speed: +-10 m, 100 m/s.
  void limit(Q& q, Q& v) const noexcept;
  [[nodiscard]] Vec3 tip(const Q& q) const noexcept { return {q[0], rest[1], rest[2]}; }
  [[nodiscard]] Vec3 tip_velocity(const Q&, const Q& v) const noexcept { return {v[0], 0, 0}; }
  [[nodiscard]] double penetration(const Q& q) const noexcept;

  Environment environment;
  double mass, friction, damping;
  Vec3 rest;  ///< tip at the start
};

/// The simulated Touch: (M(q) + m_h J^T J) q'' + C(q, q') q' + G(q) + friction + J^T b J q' = tau + J^T F.
struct TouchDynamics {
  static constexpr bool kPrismatic = false;
  static constexpr int kJoints = 3;
  using Q = Vec3;

  TouchDynamics(const SimDeviceSpec& spec, const EnvironmentSpec& surfaces) noexcept;

  /// Returns the forces at joint angles `q` [rad] and rates `v` [rad/s], `t` [s] after the begin of the period.
  template <class S>
  [[nodiscard]] Forces<S, 3> forces(const Eigen::Matrix<S, 3, 1>& q, const Eigen::Matrix<S, 3, 1>& v,
                                    const PlantDrive& drive, S t) const noexcept;
  /// Limits angles to 0.6 rad beyond the stops, and rates to 200 rad/s.
  void limit(Q& q, Q& v) const noexcept;
  [[nodiscard]] Vec3 tip(const Q& q) const noexcept;
  [[nodiscard]] Vec3 tip_velocity(const Q& q, const Q& v) const noexcept;
  [[nodiscard]] double penetration(const Q& q) const noexcept { return environment.penetration(tip(q)); }

  Environment environment;
  Vec3 friction, friction_rate2;  ///< per joint [N m], [rad^2/s^2]
  double damping, load;
  bool gravity;
};

}  // namespace tandem::hal::sim
