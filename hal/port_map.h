#pragma once

#include <cstddef>

#include "common/base/axes.h"
#include "hal/device.h"
#include "proto/scene_spec.h"

namespace tandem::hal {

/// Tip force [N] whose joint effort is `tau`: solves J^T F = tau.
/// Least squares when joints are redundant, least norm when there are fewer than three. Near a singular pose the
/// solution is damped (variable damping after Nakamura and Hanafusa 1986), so |F| stays within about 15 times its
/// ordinary lever ratio.
/// @param J       columns: joints, unused ones zero
/// @param tau     joint effort [N m] or [N]; non-finite entries count as 0
/// @param joints  how many columns are used, 0..kAxesMax
/// Total: finite for every input. Real-time safe.
[[nodiscard]] Vec3 solve_tip_force(const Jacobian& J, const AxisArray& tau,
                                   std::size_t joints) noexcept TANDEM_REALTIME;

/// Translates between what a device speaks (joints) and what the control laws speak (a port of `dof` axes).
/// kTip: the port is the tip along x, y, z [m, m/s, N], frame HAL. kJoint: the port is the joints [rad or m, ..., N m
/// or N]. Axes beyond `dof` are 0 in every result and ignored in every argument. Identity: effort . velocity of the
/// port = J^T F . dq of the joints (power is the same on both sides). Total, no heap, no state: real-time safe.
class PortMap {
 public:
  PortMap() = default;
  /// `dof` is cut to what the space (3 for kTip, `joints` for kJoint) can offer.
  PortMap(PortSpace space, std::size_t dof, std::size_t joints) noexcept;

  [[nodiscard]] PortSpace space() const noexcept { return space_; }
  [[nodiscard]] std::size_t dof() const noexcept { return dof_; }

  [[nodiscard]] AxisArray position(const State& state) const noexcept TANDEM_REALTIME;
  [[nodiscard]] AxisArray velocity(const State& state) const noexcept TANDEM_REALTIME;
  /// What the motors really gave during the last period, in port axes.
  [[nodiscard]] AxisArray delivered(const State& state) const noexcept TANDEM_REALTIME;
  /// Joint effort for `Command::effort` that makes the port effort `effort` at the pose of `state`.
  [[nodiscard]] AxisArray joint_effort(const State& state, const AxisArray& effort) const noexcept TANDEM_REALTIME;
  /// Tip force [N] that the port effort `effort` means at the pose of `state`.
  [[nodiscard]] Vec3 tip_force(const State& state, const AxisArray& effort) const noexcept TANDEM_REALTIME;
  /// Port effort of a force [N] at the tip; the inverse of `tip_force` away from singular poses.
  [[nodiscard]] AxisArray effort(const State& state, const Vec3& force) const noexcept TANDEM_REALTIME;
  /// Factor from a gain at the tip to a gain of each port axis at this pose: 1 for kTip, diag(J^T J) for kJoint.
  [[nodiscard]] AxisArray scale(const State& state) const noexcept TANDEM_REALTIME;

 private:
  PortSpace space_ = PortSpace::kTip;
  std::size_t dof_ = 0;
  std::size_t joints_ = 0;
};

}  // namespace tandem::hal
