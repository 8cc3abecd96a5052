#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>

#include "hal/device.h"

/// Delta mechanism of the Novint Falcon. Source: R. E. Stamper, "A three degree of freedom parallel manipulator with only
/// translational degrees of freedom", PhD thesis, University of Maryland 1997; dimensions as public drivers use them.
/// Leg angles theta [rad] are those of the three thighs; everything public is in the HAL frame (x right, y away from the
/// user, z up), whose origin lies on the device's axis, kFalconOrigin in front of its base plate. The mechanism's own
/// frame has z out of the device towards the user and y up: (x, y, z) of it is HAL (x, kFalconOrigin - z, y).
namespace tandem::hal {

inline constexpr double kFalconOrigin = 0.1175;  ///< middle of the good reach along the axis, 85 to 150 mm [m]
/// Box of the tip in which the condition of every pose is below kConditionFull: x and z to both sides, y by half of that
/// good reach [m].
inline constexpr double kFalconSide = 0.045, kFalconDepth = 0.0325;
inline constexpr double kFalconZeroAngle = 35.0 * std::numbers::pi / 180.0;  ///< of a leg whose encoder says 0 [rad]
/// 320 lines, counted four times each; capstan 14.25 mm on a sector of 110 mm [rad per count].
inline constexpr double kFalconRadPerCount = 2.0 * std::numbers::pi / (4.0 * 320.0) * 14.25 / 110.0;
/// Beyond these a leg meets its stops or the mechanism has no pose [rad].
inline constexpr double kFalconAngleMin = -42.0 * std::numbers::pi / 180.0;
inline constexpr double kFalconAngleMax = 116.0 * std::numbers::pi / 180.0;

/// Where the tip is and how it moves with the legs.
struct FalconPose {
  Vec3 x = Vec3::Zero();                                 ///< tip [m], HAL
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();       ///< tip velocity = J * leg rates [m/rad]
  Eigen::Matrix3d J_inv = Eigen::Matrix3d::Identity();   ///< leg rates = J_inv * tip velocity [rad/m]
  double condition = 1;                                  ///< largest by smallest singular value of J, >= 1
};

/// Leg angles of a tip position, knees outward; nothing if no pose has it there or `x` is not finite.
[[nodiscard]] std::optional<Vec3> falcon_inverse(const Vec3& x) noexcept TANDEM_REALTIME;

/// Pose at a tip position (the angles follow by falcon_inverse); nothing beyond the reach and at singular poses.
[[nodiscard]] std::optional<FalconPose> falcon_pose_at(const Vec3& x) noexcept TANDEM_REALTIME;

/// Pose of given leg angles by Newton's method on falcon_inverse, residual below 1e-12 rad.
/// @param guess  tip near it, such as the last one [m]; if that leads nowhere, the middle of the workspace is tried
/// @return nothing if no pose was found: such angles are no reading of a whole device
[[nodiscard]] std::optional<FalconPose> falcon_forward(const Vec3& theta, const Vec3& guess) noexcept TANDEM_REALTIME;

/// Share of the ordered effort that a pose may get: 1 up to kConditionFull, 0 from kConditionNone, linear between. Near
/// singular poses small leg efforts make large forces, and small errors of angle large ones of position.
inline constexpr double kConditionFull = 8;
inline constexpr double kConditionNone = 16;
[[nodiscard]] double falcon_effort_share(double condition) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal
