#pragma once

#include "hal/sim/plant_dynamics.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// A simulated device whose motion is stepped by chosen numerics (`device { numerics { } }` of a scene). Without that
/// key a device is a LinearPlant or a TouchPlant, which this class does not slow down.
/// Deterministic, no heap, total: efforts are limited as in those plants. A step whose result is not finite leaves the
/// device where it was, at rest. SEMI_IMPLICIT_EULER and RK4 are stable for small steps only.
template <class Dynamics>
class IntegratedPlant {
 public:
  static constexpr bool kPrismatic = Dynamics::kPrismatic;
  static constexpr std::size_t kJoints = Dynamics::kJoints;
  using Q = typename Dynamics::Q;

  /// @param numerics  `substeps` is the number of steps per `advance`
  /// @param q0        joints at the start, at rest
  IntegratedPlant(const Dynamics& dynamics, const NumericsSpec& numerics, const Q& q0) noexcept
      : dynamics_(dynamics), numerics_(numerics), q_(q0) {}

  /// Advances by `dt` [s] under the effort `tau` of the motors; entries that are not finite count as 0.
  void advance(const Vec3& tau, const HandPull& hand, double dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] Vec3 q() const noexcept { return in_space(q_); }
  [[nodiscard]] Vec3 dq() const noexcept { return in_space(v_); }
  [[nodiscard]] Vec3 tip() const noexcept { return dynamics_.tip(q_); }
  [[nodiscard]] Vec3 tip_velocity() const noexcept { return dynamics_.tip_velocity(q_, v_); }
  /// Force on the tip, mean of the last advance [N].
  [[nodiscard]] const Vec3& environment_force() const noexcept { return environment_; }
  /// Likewise of the hand, without its inertia.
  [[nodiscard]] const Vec3& hand_force() const noexcept { return hand_; }
  [[nodiscard]] double penetration() const noexcept { return dynamics_.penetration(q_); }
  /// For tests: sets position and velocity of the joints.
  void set(const Q& q, const Q& v) noexcept {
    q_ = q;
    v_ = v;
  }

 private:
  [[nodiscard]] static Vec3 in_space(const Q& joints) noexcept {
    Vec3 out = Vec3::Zero();
    out.head<Dynamics::kJoints>() = joints;
    return out;
  }
  template <class S>
  void advance_in(const PlantDrive& drive) noexcept;

  Dynamics dynamics_;
  NumericsSpec numerics_;
  Q q_, v_ = Q::Zero();
  Vec3 environment_ = Vec3::Zero(), hand_ = Vec3::Zero();
};

extern template class IntegratedPlant<LinearDynamics>;
extern template class IntegratedPlant<TouchDynamics>;

}  // namespace tandem::hal::sim
