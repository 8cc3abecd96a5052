#include "hal/sim/touch_kinematics.h"

#include <cmath>
#include <numbers>

namespace tandem::hal::sim {

TouchPose::TouchPose(const Vec3& q) noexcept
    : s1(std::sin(q[0])),
      c1(std::cos(q[0])),
      s2(std::sin(q[1])),
      c2(std::cos(q[1])),
      s3(std::sin(q[2])),
      c3(std::cos(q[2])),
      rho(kTouchL1 * c2 + kTouchL2 * s3) {}

Eigen::Matrix3d TouchPose::jacobian() const noexcept {
  Eigen::Matrix3d j;
  j << -c1 * rho, s1 * kTouchL1 * s2, -s1 * kTouchL2 * c3,  //
      s1 * rho, c1 * kTouchL1 * s2, -c1 * kTouchL2 * c3,    //
      0.0, kTouchL1 * c2, kTouchL2 * s3;
  return j;
}

std::optional<Vec3> touch_inverse(const Vec3& tip) noexcept {
  // In the vertical plane of the arm, link 1 starts at the origin at elevation q2; link 2 is at elevation q3 - 90
  // degrees.
  const double forward = kTouchW - tip[1];
  const double rho = std::hypot(tip[0], forward);
  const double height = tip[2] - kTouchH;
  const double r2 = rho * rho + height * height;
  const double r = std::sqrt(r2);
  if (!(rho > 1e-6) || !(r > 1e-6)) return std::nullopt;
  const double cos_upper = (r2 + kTouchL1 * kTouchL1 - kTouchL2 * kTouchL2) / (2.0 * r * kTouchL1);
  const double cos_lower = (r2 + kTouchL2 * kTouchL2 - kTouchL1 * kTouchL1) / (2.0 * r * kTouchL2);
  if (!(std::abs(cos_upper) <= 1.0) || !(std::abs(cos_lower) <= 1.0)) return std::nullopt;
  const double elevation = std::atan2(height, rho);
  return Vec3(std::atan2(-tip[0], forward), elevation + std::acos(cos_upper),
              elevation - std::acos(cos_lower) + std::numbers::pi / 2.0);
}

}  // namespace tandem::hal::sim
