#pragma once

#include <Eigen/Core>
#include <optional>

#include "hal/core/device.h"

/// Kinematics of the simulated Touch: three actuated joints. q3 is absolute: measured against gravity, not against link
/// 2. Joint vectors are (q1, q2, q3) [rad]. Positions and forces are in the HAL frame: vendor (x, y, z) is HAL (x, -z,
/// y).
namespace tandem::hal::sim {

inline constexpr double kTouchL1 = 0.13335;  ///< upper link [m]
inline constexpr double kTouchL2 = 0.13335;  ///< lower link [m]
inline constexpr double kTouchH = 0.02335;   ///< distance of the vendor's origin below the base [m]
inline constexpr double kTouchW = 0.16835;   ///< vendor's origin in front of the base [m]

/// Sines and cosines of a pose, computed once and shared.
struct TouchPose {
  double s1 = 0, c1 = 1, s2 = 0, c2 = 1, s3 = 0, c3 = 1;
  double rho = kTouchL1;  ///< distance of the tip from the axis of joint 1 [m]

  TouchPose() = default;
  explicit TouchPose(const Vec3& q) noexcept;

  /// Returns the tip position [m].
  [[nodiscard]] Vec3 tip() const noexcept {
    return {-s1 * rho, kTouchW - c1 * rho, kTouchL1 * s2 - kTouchL2 * c3 + kTouchH};
  }
  /// Returns the 3x3 Jacobian [m/rad]: tip velocity = jacobian * dq.
  [[nodiscard]] Eigen::Matrix3d jacobian() const noexcept;
  /// Returns jacobian * dq [m/s] without forming the Jacobian.
  [[nodiscard]] Vec3 tip_velocity(const Vec3& dq) const noexcept {
    const double radial = -kTouchL1 * s2 * dq[1] + kTouchL2 * c3 * dq[2];
    return {-c1 * rho * dq[0] - s1 * radial, s1 * rho * dq[0] - c1 * radial,
            kTouchL1 * c2 * dq[1] + kTouchL2 * s3 * dq[2]};
  }
  /// Returns jacobian^T * force [N m] without forming the Jacobian.
  [[nodiscard]] Vec3 joint_effort(const Vec3& f) const noexcept {
    const double radial = -(s1 * f[0] + c1 * f[1]);
    return {rho * (s1 * f[1] - c1 * f[0]), kTouchL1 * (c2 * f[2] - s2 * radial), kTouchL2 * (c3 * radial + s3 * f[2])};
  }
};

/// Returns the joint angles [rad] with the elbow up and the tip in front of the base (rho > 0). Empty: `tip` [m] is out
/// of reach or not finite.
/// At the vendor's origin: (0, 0.742, 0.553) rad.
[[nodiscard]] std::optional<Vec3> touch_inverse(const Vec3& tip) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal::sim
