#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "hal/core/device.h"
#include "proto/spec/woodenhaptics_spec.h"

namespace tandem::hal::woodenhaptics {

/// Kinematics of WoodenHaptics 2015/2019, AluHaptics and Polhem v1: a rotating base, then two links in its vertical
/// plane.
/// Joints q = (A, B, C) [rad]: A about the vertical, B of the upper arm from the vertical, C of the forearm from
/// hanging down, absolute.
/// Maker's frame of the base: x towards the user, y to the user's right, z up, as the published library passes it to
/// CHAI3D:
///   rho = Lb sin B + Lc sin C;  tip = (rho cos A, rho sin A, La + Lb cos B - Lc cos C) - origin.
/// HAL frame: x = maker's y, y = -maker's x, z = z. Total: finite in, finite out. No heap.
class Kinematics {
 public:
  explicit Kinematics(const WoodenHapticsSpec& spec) noexcept;

  /// Returns the angle of one encoder count, signed by the encoder's direction [rad].
  [[nodiscard]] const Vec3& angle_per_count() const noexcept { return angle_per_count_; }
  [[nodiscard]] Vec3 angles(const std::array<std::int32_t, 3>& counts) const noexcept TANDEM_REALTIME;
  /// Returns the tip position [m], HAL frame.
  [[nodiscard]] Vec3 tip(const Vec3& q) const noexcept TANDEM_REALTIME;
  /// Returns the Jacobian [m/rad]: tip velocity = jacobian * dq; joint effort = jacobian^T * tip force.
  [[nodiscard]] Eigen::Matrix3d jacobian(const Vec3& q) const noexcept TANDEM_REALTIME;
  /// Returns the joint angles [rad]: elbow up, tip in front of the base, A in (-pi/2, pi/2).
  /// Empty: out of reach, on the axis of the base, or not finite.
  [[nodiscard]] std::optional<Vec3> inverse(const Vec3& tip) const noexcept TANDEM_REALTIME;
  /// Returns the joint effort that balances the gravity of both arms [N m]: the derivative of their potential
  /// U = g (mb lb cos B + mc (Lb cos B - lc cos C)).
  [[nodiscard]] Vec3 holding_effort(const Vec3& q) const noexcept TANDEM_REALTIME;
  /// Returns the potential U [J].
  [[nodiscard]] double potential(const Vec3& q) const noexcept TANDEM_REALTIME;

 private:
  Vec3 angle_per_count_;
  double height_, upper_, fore_;
  Vec3 origin_;
  double weight_b_, weight_c_;  ///< moments of gravity about shoulder and elbow [N m]
};

}  // namespace tandem::hal::woodenhaptics
