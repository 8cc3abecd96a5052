#pragma once

#include "hal/core/device.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// Position [m] and velocity [m/s] of an intended motion, HAL frame.
struct MotionPoint {
  Vec3 x = Vec3::Zero();
  Vec3 v = Vec3::Zero();
};

/// Minimum-jerk step from 0 to 1 over u in [0, 1], constant outside [Flash, Hogan 1985]. `rate` is its derivative by u.
struct MinJerk {
  double value = 0;
  double rate = 0;
};
[[nodiscard]] constexpr MinJerk min_jerk(double u) noexcept {
  if (!(u > 0.0)) return {0.0, 0.0};
  if (u >= 1.0) return {1.0, 0.0};
  const double u2 = u * u;
  return {u2 * u * (10.0 - 15.0 * u + 6.0 * u2), 30.0 * u2 * (1.0 - u) * (1.0 - u)};
}

[[nodiscard]] inline Vec3 to_vec3(const Point& p) noexcept { return {p.x, p.y, p.z}; }

/// Returns the point of a trajectory at time `t` [s].
/// Circle: center + r(t) (cos wt, sin wt) in the plane normal to `plane`. r grows from 0 with minimum jerk in `ramp`,
/// so the motion starts at the center and at rest.
/// Waypoints: held before the first and after the last, minimum jerk in between.
/// Total: non-finite time counts as 0. Real-time safe.
[[nodiscard]] MotionPoint at(const Trajectory& trajectory, double t) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal::sim
