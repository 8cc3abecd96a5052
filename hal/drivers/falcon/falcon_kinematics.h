#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>

#include "hal/core/device.h"

/// Kinematics of the Novint Falcon's delta mechanism.
/// Source: R. E. Stamper, "A three degree of freedom parallel manipulator with only translational degrees of freedom",
/// PhD thesis, University of Maryland 1997; dimensions as in public drivers.
/// Leg angles theta [rad] are those of the three thighs.
/// Public functions use the HAL frame (x right, y away from the user, z up). Its origin is on the device's axis,
/// kFalconOrigin in front of the base plate.
/// The mechanism's own frame has z out of the device towards the user and y up: its (x, y, z) is HAL (x, kFalconOrigin
/// - z, y).
namespace tandem::hal {

inline constexpr double kFalconOrigin = 0.1175;  ///< middle of the usable reach along the axis, 85 to 150 mm [m]
/// Half sides of the workspace box [m], in which every pose has a condition below kConditionFull.
/// kFalconSide is for x and z; kFalconDepth, half of the usable reach, is for y.
inline constexpr double kFalconSide = 0.045, kFalconDepth = 0.0325;
/// Angle of a leg at encoder count 0 [rad].
inline constexpr double kFalconZeroAngle = 35.0 * std::numbers::pi / 180.0;
/// Leg angle per count [rad per count]: 320 lines, counted four times each; capstan 14.25 mm on a sector of 110 mm.
inline constexpr double kFalconRadPerCount = 2.0 * std::numbers::pi / (4.0 * 320.0) * 14.25 / 110.0;
/// Range of leg angles [rad]: outside it a leg meets its stops or the mechanism has no pose.
inline constexpr double kFalconAngleMin = -42.0 * std::numbers::pi / 180.0;
inline constexpr double kFalconAngleMax = 116.0 * std::numbers::pi / 180.0;

/// Tip position and its dependence on the legs.
struct FalconPose {
  Vec3 x = Vec3::Zero();                                ///< tip [m], HAL
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();      ///< tip velocity = J * leg rates [m/rad]
  Eigen::Matrix3d J_inv = Eigen::Matrix3d::Identity();  ///< leg rates = J_inv * tip velocity [rad/m]
  double condition = 1;                                 ///< largest singular value of J divided by the smallest, >= 1
};

/// Returns the leg angles [rad] of a tip position [m], knees outward. Empty: no pose reaches it, or `x` is not finite.
[[nodiscard]] std::optional<Vec3> falcon_inverse(const Vec3& x) noexcept TANDEM_REALTIME;

/// Returns the pose at a tip position [m]; falcon_inverse gives its angles. Empty: out of reach, or a singular pose.
[[nodiscard]] std::optional<FalconPose> falcon_pose_at(const Vec3& x) noexcept TANDEM_REALTIME;

/// Returns the pose of given leg angles [rad], by Newton's method on falcon_inverse; residual below 1e-12 rad.
/// @param guess  approximate tip position, such as the last one [m]; if it does not converge, the middle of the
///           workspace is tried
/// @return empty: no pose was found; such angles are no valid reading
[[nodiscard]] std::optional<FalconPose> falcon_forward(const Vec3& theta, const Vec3& guess) noexcept TANDEM_REALTIME;

/// Share of the commanded effort that a pose may get: 1 up to kConditionFull, 0 from kConditionNone, linear between.
/// Near singular poses small leg efforts cause large forces, and small angle errors cause large position errors.
inline constexpr double kConditionFull = 8;
inline constexpr double kConditionNone = 16;
[[nodiscard]] double falcon_effort_share(double condition) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal
