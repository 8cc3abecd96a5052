#pragma once

#include <cstddef>

#include "common/base/axes.h"
#include "hal/core/device.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal {

/// Returns the tip force [N] whose joint effort is `tau`: solves J^T F = tau.
/// The solution is least squares if joints are redundant, and least norm if there are fewer than three.
/// Near a singular pose it is damped (variable damping after Nakamura and Hanafusa 1986): |F| stays within about 15
/// times its ordinary lever ratio.
/// @param J       columns: joints, unused ones zero
/// @param tau     joint effort [N m] or [N]; non-finite entries count as 0
/// @param joints  number of used columns, 0..kAxesMax
/// Total: finite for every input. Real-time safe.
[[nodiscard]] Vec3 solve_tip_force(const Jacobian& J, const AxisArray& tau,
                                   std::size_t joints) noexcept TANDEM_REALTIME;

/// Map between the joints of a device and the port of `dof` axes that the control laws use.
/// kTip: the port is the tip along x, y, z [m, m/s, N], frame HAL. kJoint: the port is the joints [rad or m, rad/s or
/// m/s, N m or N].
/// Axes beyond `dof` are 0 in every result and ignored in every argument.
/// Identity: effort . velocity of the port = J^T F . dq of the joints (power is the same on both sides).
/// Total, no heap, no state: real-time safe.
class PortMap {
 public:
  PortMap() = default;
  /// `dof` is limited to 3 for kTip and to `joints` for kJoint.
  PortMap(PortSpace space, std::size_t dof, std::size_t joints) noexcept;

  /// Returns the space of the port.
  [[nodiscard]] PortSpace space() const noexcept { return space_; }
  /// Returns the number of axes of the port.
  [[nodiscard]] std::size_t dof() const noexcept { return dof_; }

  /// Returns the position of the port [m or rad].
  [[nodiscard]] AxisArray position(const State& state) const noexcept TANDEM_REALTIME;
  /// Returns the velocity of the port [m/s or rad/s].
  [[nodiscard]] AxisArray velocity(const State& state) const noexcept TANDEM_REALTIME;
  /// Returns the effort the motors delivered during the last period, in port axes.
  [[nodiscard]] AxisArray delivered(const State& state) const noexcept TANDEM_REALTIME;
  /// Returns the joint effort for `Command::effort` that produces the port effort `effort` at the pose of `state`.
  [[nodiscard]] AxisArray joint_effort(const State& state, const AxisArray& effort) const noexcept TANDEM_REALTIME;
  /// Returns the tip force [N] of the port effort `effort` at the pose of `state`.
  [[nodiscard]] Vec3 tip_force(const State& state, const AxisArray& effort) const noexcept TANDEM_REALTIME;
  /// Returns the port effort of a force [N] at the tip; the inverse of `tip_force` away from singular poses.
  [[nodiscard]] AxisArray effort(const State& state, const Vec3& force) const noexcept TANDEM_REALTIME;
  /// Returns the factor from a tip gain to the gain of each port axis at this pose: 1 for kTip, diag(J^T J) for kJoint.
  [[nodiscard]] AxisArray scale(const State& state) const noexcept TANDEM_REALTIME;

 private:
  PortSpace space_ = PortSpace::kTip;
  std::size_t dof_ = 0;
  std::size_t joints_ = 0;
};

}  // namespace tandem::hal
