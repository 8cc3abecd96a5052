#include "hal/sim/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tandem::hal::sim {
namespace {

MotionPoint circle(const Trajectory& c, double t) noexcept {
  MotionPoint p{to_vec3(c.center), Vec3::Zero()};
  if (t <= 0.0 && c.ramp > 0.0) return p;
  const double omega = 2.0 * std::numbers::pi * c.frequency;
  const MinJerk grow = c.ramp > 0.0 ? min_jerk(t / c.ramp) : MinJerk{1.0, 0.0};
  const double r = c.radius * grow.value;
  const double dr = c.ramp > 0.0 ? c.radius * grow.rate / c.ramp : 0.0;
  const double cs = std::cos(omega * t);
  const double sn = std::sin(omega * t);
  const int u = c.plane == 'x' ? 1 : 0;
  const int v = c.plane == 'z' ? 1 : 2;
  p.x[u] += r * cs;
  p.x[v] += r * sn;
  p.v[u] = dr * cs - r * omega * sn;
  p.v[v] = dr * sn + r * omega * cs;
  return p;
}

MotionPoint waypoints(const Trajectory& w, double t) noexcept {
  if (w.waypoints.empty()) return {to_vec3(w.center), Vec3::Zero()};
  const auto next = std::upper_bound(w.waypoints.begin(), w.waypoints.end(), t,
                                     [](double time, const Waypoint& p) { return time < p.at; });
  if (next == w.waypoints.begin()) return {to_vec3(next->p), Vec3::Zero()};
  const auto& from = *(next - 1);
  if (next == w.waypoints.end()) return {to_vec3(from.p), Vec3::Zero()};
  const double span = next->at - from.at;  // > 0: upper_bound found from.at <= t < next->at
  const MinJerk s = min_jerk((t - from.at) / span);
  const Vec3 way = to_vec3(next->p) - to_vec3(from.p);
  return {to_vec3(from.p) + s.value * way, s.rate / span * way};
}

}  // namespace

MotionPoint at(const Trajectory& trajectory, double t) noexcept {
  if (!std::isfinite(t)) t = 0.0;
  return trajectory.kind == Trajectory::Kind::kCircle ? circle(trajectory, t) : waypoints(trajectory, t);
}

}  // namespace tandem::hal::sim
