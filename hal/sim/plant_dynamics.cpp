#include "hal/sim/plant_dynamics.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/touch_constants.h"
#include "hal/sim/touch_plant.h"

namespace tandem::hal::sim {
namespace {

constexpr double kPullMax = 1000.0;                         ///< of a hand [N]
constexpr double kRailEnd = 10.0, kRailSpeed = 100.0;       ///< [m, m/s]
constexpr double kJointSpeed = 200.0, kLeastSpeed = 1e-30;  ///< [rad/s]; less would become denormal

template <class S>
using Tip = Eigen::Matrix<S, 3, 1>;

template <class S>
S within(S value, S limit) noexcept {
  return std::isfinite(value) ? std::clamp(value, -limit, limit) : S(0);
}

/// Force of the hand on a tip at `x`, without the part that its damper takes from the tip's velocity.
template <class S>
Tip<S> pull_of(const PlantDrive& drive, const Tip<S>& x, S t) noexcept {
  const HandPull& hand = drive.hand;
  const Tip<S> at = hand.x.cast<S>() + (t - static_cast<S>(drive.length / 2)) * hand.v.cast<S>();
  Tip<S> pull = static_cast<S>(hand.k) * (at - x) + (hand.b * hand.v + hand.force).cast<S>();
  for (int i = 0; i < 3; ++i) pull[i] = within(pull[i], static_cast<S>(kPullMax));
  return pull;
}

/// A touched surface: its push along the normal, and its spring and damper. It never pulls.
template <class S>
struct Push {
  S force = 0, k = 0, b = 0;
};
template <class S>
Push<S> push_of(const Surface& surface, const Tip<S>& x, const Tip<S>& v) noexcept {
  const S sign = static_cast<S>(surface.sign);
  const S depth = sign * (static_cast<S>(surface.at) - x[surface.axis]);
  if (!(depth > 0)) return {};
  const S b = static_cast<S>(surface.b);
  const S force = static_cast<S>(surface.spring(static_cast<double>(depth))) - b * sign * v[surface.axis];
  if (!(force > 0)) return {};
  return {force, static_cast<S>(surface.slope(static_cast<double>(depth))), b};
}

/// Sines, cosines and Jacobian of a pose, in numbers of type S; as TouchPose.
template <class S>
struct Pose {
  explicit Pose(const Tip<S>& q) noexcept
      : s1(std::sin(q[0])),
        c1(std::cos(q[0])),
        s2(std::sin(q[1])),
        c2(std::cos(q[1])),
        s3(std::sin(q[2])),
        c3(std::cos(q[2])) {
    const S l1 = static_cast<S>(kTouchL1), l2 = static_cast<S>(kTouchL2);
    rho = l1 * c2 + l2 * s3;
    jacobian << -c1 * rho, s1 * l1 * s2, -s1 * l2 * c3,  //
        s1 * rho, c1 * l1 * s2, -c1 * l2 * c3,           //
        S(0), l1 * c2, l2 * s3;
    tip << -s1 * rho, static_cast<S>(kTouchW) - c1 * rho, l1 * s2 - l2 * c3 + static_cast<S>(kTouchH);
  }
  S s1, c1, s2, c2, s3, c3, rho{};
  Eigen::Matrix<S, 3, 3> jacobian;
  Tip<S> tip;
};

/// Adds the mechanical stops: springs and dampers beyond a range.
template <class S>
void add_stops(const Tip<S>& q, const Tip<S>& v, Forces<S, 3>& out) noexcept {
  using namespace touch;
  const S k = static_cast<S>(kStopK), b = static_cast<S>(kStopB);
  const auto add = [&](const Tip<S>& row, S over) {
    if (over == 0) return;
    out.f -= (k * over + b * row.dot(v)) * row;
    out.k += k * row * row.transpose();
    out.b += b * row * row.transpose();
  };
  for (int i = 0; i < 3; ++i) {
    const auto s = static_cast<std::size_t>(i);
    add(Tip<S>::Unit(i), q[i] - std::clamp(q[i], static_cast<S>(kStopLow[s]), static_cast<S>(kStopHigh[s])));
  }
  const S elbow = q[2] - q[1], most = static_cast<S>(kStopElbow);
  add(Tip<S>(0, -1, 1), elbow - std::clamp(elbow, -most, most));
}

/// Adds inertia, Coriolis and centrifugal forces of device, load and hand, as TouchPlant has them.
template <class S>
void add_inertia(const Pose<S>& p, const Tip<S>& v, S m, Forces<S, 3>& out) noexcept {
  using namespace touch;
  const S l1 = static_cast<S>(kL1), l2 = static_cast<S>(kL2), r3 = static_cast<S>(kR3), m3 = static_cast<S>(kM3);
  const S link2 = static_cast<S>(kM2 * kR2 * kR2);
  const S sd = p.s3 * p.c2 - p.c3 * p.s2, cd = p.c3 * p.c2 + p.s3 * p.s2;
  const S arm = l1 * p.c2 + r3 * p.s3, kappa = static_cast<S>(kM23) + m * l1 * l2;
  out.m(0, 0) = static_cast<S>(kI) + link2 * p.c2 * p.c2 + m3 * arm * arm + m * p.rho * p.rho;
  out.m(1, 1) = static_cast<S>(kM22) + m * l1 * l1;
  out.m(2, 2) = static_cast<S>(kM33) + m * l2 * l2;
  out.m(1, 2) = out.m(2, 1) = kappa * sd;
  const S d2 = S(-2) * p.s2 * (link2 * p.c2 + l1 * (m3 * arm + m * p.rho));
  const S d3 = S(2) * p.c3 * (m3 * r3 * arm + m * l2 * p.rho);
  out.f[0] -= (d2 * v[1] + d3 * v[2]) * v[0];
  out.f[1] -= kappa * cd * v[2] * v[2] - d2 * v[0] * v[0] / 2;
  out.f[2] += kappa * cd * v[1] * v[1] + d3 * v[0] * v[0] / 2;
}

}  // namespace

LinearDynamics::LinearDynamics(const SimDeviceSpec& spec, const EnvironmentSpec& surfaces, const Vec3& start) noexcept
    : environment(surfaces), mass(spec.mass + spec.load), friction(spec.friction), damping(spec.damping), rest(start) {}

template <class S>
Forces<S, 1> LinearDynamics::forces(const Eigen::Matrix<S, 1, 1>& q, const Eigen::Matrix<S, 1, 1>& v,
                                    const PlantDrive& drive, S t) const noexcept {
  Forces<S, 1> out;
  const Tip<S> x(q[0], static_cast<S>(rest[1]), static_cast<S>(rest[2])), dx(v[0], 0, 0);
  const S pull = pull_of<S>(drive, x, t)[0], hand_b = static_cast<S>(drive.hand.b),
          slow = static_cast<S>(kFrictionSpeed);
  const S secant = static_cast<S>(friction) / std::sqrt(v[0] * v[0] + slow * slow);
  out.m(0, 0) = static_cast<S>(mass + drive.hand.m);
  out.k(0, 0) = static_cast<S>(drive.hand.k);
  out.b(0, 0) = static_cast<S>(damping) + hand_b + secant;
  out.f[0] = static_cast<S>(drive.tau[0]) + pull - out.b(0, 0) * v[0];
  out.hand[0] = pull - hand_b * v[0];
  for (std::size_t i = 0; i < environment.size(); ++i) {
    if (environment[i].axis != 0) continue;
    const Push<S> push = push_of<S>(environment[i], x, dx);
    out.environment[0] += static_cast<S>(environment[i].sign) * push.force;
    out.k(0, 0) += push.k;
    out.b(0, 0) += push.b;
  }
  out.f[0] += out.environment[0];
  return out;
}

void LinearDynamics::limit(Q& q, Q& v) const noexcept {
  v[0] = within(v[0], kRailSpeed);
  if (std::abs(v[0]) < kLeastSpeed) v[0] = 0;
  if (!(std::abs(q[0]) > kRailEnd)) return;
  q[0] = std::clamp(q[0], -kRailEnd, kRailEnd);
  v[0] = 0;
}

double LinearDynamics::penetration(const Q& q) const noexcept {
  double deepest = 0;
  for (std::size_t i = 0; i < environment.size(); ++i)
    if (environment[i].axis == 0) deepest = std::max(deepest, environment[i].penetration(tip(q)));
  return deepest;
}

TouchDynamics::TouchDynamics(const SimDeviceSpec& spec, const EnvironmentSpec& surfaces) noexcept
    : environment(surfaces),
      friction(TouchPlant::joint_friction(spec.friction)),
      friction_rate2((kFrictionSpeed * TouchPlant::working_levers().cwiseInverse()).array().square()),
      damping(spec.damping),
      load(spec.load),
      gravity(spec.gravity) {}

template <class S>
Forces<S, 3> TouchDynamics::forces(const Eigen::Matrix<S, 3, 1>& q, const Eigen::Matrix<S, 3, 1>& v,
                                   const PlantDrive& drive, S t) const noexcept {
  Forces<S, 3> out;
  const Pose<S> p(q);
  out.f = drive.tau.cast<S>();
  add_inertia<S>(p, v, static_cast<S>(drive.hand.m + load), out);
  if (gravity) {
    out.f[1] -= static_cast<S>(touch::kG2 + load * touch::kG * touch::kL1) * p.c2;
    out.f[2] -= static_cast<S>(touch::kG3 + load * touch::kG * touch::kL2) * p.s3;
  }
  const Tip<S> dx = p.jacobian * v, pull = pull_of<S>(drive, p.tip, t);
  const S hand_b = static_cast<S>(drive.hand.b), b = static_cast<S>(damping) + hand_b;
  out.hand = pull - hand_b * dx;
  out.f += p.jacobian.transpose() * (pull - b * dx);
  const Eigen::Matrix<S, 3, 3> square = p.jacobian.transpose() * p.jacobian;
  out.k = static_cast<S>(drive.hand.k) * square;
  out.b = b * square;
  for (int i = 0; i < 3; ++i) {
    const S secant = static_cast<S>(friction[i]) / std::sqrt(v[i] * v[i] + static_cast<S>(friction_rate2[i]));
    out.f[i] -= secant * v[i];
    out.b(i, i) += secant;
  }
  add_stops<S>(q, v, out);
  for (std::size_t i = 0; i < environment.size(); ++i) {
    const Surface& surface = environment[i];
    const Push<S> push = push_of<S>(surface, p.tip, dx);
    if (!(push.force > 0)) continue;
    const S sign = static_cast<S>(surface.sign);
    const Tip<S> row = sign * p.jacobian.row(surface.axis).transpose();
    out.environment[surface.axis] += sign * push.force;
    out.f += push.force * row;
    out.k += push.k * row * row.transpose();
    out.b += push.b * row * row.transpose();
  }
  return out;
}

void TouchDynamics::limit(Q& q, Q& v) const noexcept {
  for (int i = 0; i < 3; ++i) {
    const auto s = static_cast<std::size_t>(i);
    v[i] = within(v[i], kJointSpeed);
    if (std::abs(v[i]) < kLeastSpeed) v[i] = 0;
    const double held = std::clamp(q[i], touch::kStopLow[s] - touch::kStopSoft, touch::kStopHigh[s] + touch::kStopSoft);
    if (held == q[i]) continue;
    q[i] = held;
    v[i] = 0;
  }
}

Vec3 TouchDynamics::tip(const Q& q) const noexcept { return TouchPose(q).tip(); }
Vec3 TouchDynamics::tip_velocity(const Q& q, const Q& v) const noexcept { return TouchPose(q).tip_velocity(v); }

template Forces<double, 1> LinearDynamics::forces(const Eigen::Matrix<double, 1, 1>&,
                                                  const Eigen::Matrix<double, 1, 1>&, const PlantDrive&,
                                                  double) const noexcept;
template Forces<float, 1> LinearDynamics::forces(const Eigen::Matrix<float, 1, 1>&, const Eigen::Matrix<float, 1, 1>&,
                                                 const PlantDrive&, float) const noexcept;
template Forces<long double, 1> LinearDynamics::forces(const Eigen::Matrix<long double, 1, 1>&,
                                                       const Eigen::Matrix<long double, 1, 1>&, const PlantDrive&,
                                                       long double) const noexcept;
template Forces<long double, 3> TouchDynamics::forces(const Eigen::Matrix<long double, 3, 1>&,
                                                      const Eigen::Matrix<long double, 3, 1>&, const PlantDrive&,
                                                      long double) const noexcept;
template Forces<double, 3> TouchDynamics::forces(const Eigen::Vector3d&, const Eigen::Vector3d&, const PlantDrive&,
                                                 double) const noexcept;
template Forces<float, 3> TouchDynamics::forces(const Eigen::Vector3f&, const Eigen::Vector3f&, const PlantDrive&,
                                                float) const noexcept;

}  // namespace tandem::hal::sim
