#include "hal/sim/touch_plant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/sim/touch_constants.h"

namespace tandem::hal::sim {
namespace {

using namespace touch;

constexpr double kEffortMax = 10.0, kForceMax = 1000.0, kRateMax = 200.0, kJointRateMin = 1e-30;

/// Symmetric 3x3 matrix of the pattern [a11 0 0; 0 a22 a23; 0 a23 a33].
struct Block {
  double a11, a22, a33, a23;

  [[nodiscard]] Vec3 solve(const Vec3& r) const noexcept {
    const double inv = 1.0 / (a22 * a33 - a23 * a23);
    return {r[0] / a11, (a33 * r[1] - a23 * r[2]) * inv, (a22 * r[2] - a23 * r[1]) * inv};
  }
};

Vec3 bounded(const Vec3& v, double limit) noexcept {
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = std::isfinite(v[i]) ? std::clamp(v[i], -limit, limit) : 0.0;
  return out;
}

bool near_stop(const Vec3& q) noexcept {
  return q[0] < kStopLow[0] || q[0] > kStopHigh[0] || q[1] < kStopLow[1] || q[1] > kStopHigh[1] || q[2] < kStopLow[2] ||
         q[2] > kStopHigh[2] || std::abs(q[2] - q[1]) > kStopElbow;
}

/// Adds the mechanical stops to the step: torque into `r`, implicit terms into `a`.
void push_from_stops(const Vec3& q, const Vec3& dq, double h, Vec3& r, Block& a) noexcept {
  const double g = h * kStopB + h * h * kStopK;
  const double ahead = h * kStopK;
  std::array<double*, 3> diagonal{&a.a11, &a.a22, &a.a33};
  for (int i = 0; i < 3; ++i) {
    const auto s = static_cast<std::size_t>(i);
    const double over = q[i] - std::clamp(q[i], kStopLow[s], kStopHigh[s]);
    if (over == 0.0) continue;
    r[i] -= kStopK * over + (kStopB + ahead) * dq[i];
    *diagonal[s] += g;
  }
  const double elbow = q[2] - q[1];
  const double over = elbow - std::clamp(elbow, -kStopElbow, kStopElbow);
  if (over != 0.0) {
    const double t = kStopK * over + (kStopB + ahead) * (dq[2] - dq[1]);
    r[1] += t;
    r[2] -= t;
    a.a22 += g;
    a.a33 += g;
    a.a23 -= g;
  }
}

}  // namespace

TouchPlant::TouchPlant(const SimDeviceSpec& spec, const EnvironmentSpec& environment, const Vec3& q0) noexcept
    : environment_(environment),
      friction_(joint_friction(spec.friction)),
      damping_(spec.damping),
      load_(spec.load),
      gravity_(spec.gravity),
      q_(q0),
      pose_(q0) {
  friction_rate2_ = (kFrictionSpeed * working_levers().cwiseInverse()).array().square();
}

bool TouchPlant::within_stops(const Vec3& q) noexcept { return !near_stop(q); }

Vec3 TouchPlant::working_levers() noexcept { return {kTouchW, kL1, kL2}; }

Vec3 TouchPlant::joint_friction(double friction) noexcept { return friction * working_levers(); }

Vec3 TouchPlant::gravity(const TouchPose& p) noexcept { return {0.0, kG2 * p.c2, kG3 * p.s3}; }

Eigen::Matrix3d TouchPlant::inertia(const TouchPose& p) noexcept {
  const double arm = kL1 * p.c2 + kR3 * p.s3;
  const double m23 = kM23 * (p.s3 * p.c2 - p.c3 * p.s2);
  Eigen::Matrix3d m;
  m << kI + kM2 * kR2 * kR2 * p.c2 * p.c2 + kM3 * arm * arm, 0.0, 0.0, 0.0, kM22, m23, 0.0, m23, kM33;
  return m;
}

double TouchPlant::kinetic_energy() const noexcept {
  return 0.5 * dq_.dot(inertia(pose_) * dq_) + 0.5 * load_ * tip_velocity().squaredNorm();
}

double TouchPlant::potential_energy() const noexcept {
  return gravity_ ? kG2 * pose_.s2 - kG3 * pose_.c3 + load_ * kG * pose_.tip()[2] : 0.0;
}

void TouchPlant::set(const Vec3& q, const Vec3& dq) noexcept {
  q_ = q;
  dq_ = dq_prev_ = dq;
  pose_ = TouchPose(q);
}

void TouchPlant::advance(const Vec3& tau, const HandPull& hand, double dt) noexcept {
  if (!(dt > 0.0)) return;
  dt = std::min(dt, 1.0);
  const int n = std::max(1, static_cast<int>(std::ceil(dt / kSubstepMax - 1e-6)));
  const double h = dt / n;
  const Vec3 effort = bounded(tau, kEffortMax);
  f_environment_.setZero();
  f_hand_.setZero();
  Vec3 intended = hand.x - (0.5 * dt - 0.5 * h) * hand.v;
  for (int i = 0; i < n; ++i) {
    substep(effort, hand, intended, h);
    intended += h * hand.v;
  }
  f_environment_ /= n;
  f_hand_ /= n;
  pose_ = TouchPose(q_);
}

void TouchPlant::substep(const Vec3& tau, const HandPull& hand, const Vec3& intended, double h) noexcept {
  const TouchPose p(q_ + 0.5 * h * dq_);
  const double m = hand.m + load_;
  const double sd = p.s3 * p.c2 - p.c3 * p.s2;  // sin, cos of q3 - q2
  const double cd = p.c3 * p.c2 + p.s3 * p.s2;

  // Inertia of device, load and hand. Load and hand are point masses at the tip, so they only make link 3 heavier.
  const double arm = kL1 * p.c2 + kR3 * p.s3;
  const double kappa = kM23 + m * kL1 * kL2;
  Block a{kI + kM2 * kR2 * kR2 * p.c2 * p.c2 + kM3 * arm * arm + m * p.rho * p.rho, kM22 + m * kL1 * kL1,
          kM33 + m * kL2 * kL2, kappa * sd};

  // Coriolis and centrifugal terms from Lagrange's equations of that inertia (dM11/dq2, dM11/dq3, dM23/d(q3 - q2)).
  // They use the velocity extrapolated to the middle of the step, which makes the free motion second-order accurate.
  const Vec3 w = 1.5 * dq_ - 0.5 * dq_prev_;
  const double d2 = -2.0 * p.s2 * (kM2 * kR2 * kR2 * p.c2 + kL1 * (kM3 * arm + m * p.rho));
  const double d3 = 2.0 * p.c3 * (kM3 * kR3 * arm + m * kL2 * p.rho);
  Vec3 r = tau;
  r[0] -= (d2 * w[1] + d3 * w[2]) * w[0];
  r[1] -= kappa * cd * w[2] * w[2] - 0.5 * d2 * w[0] * w[0];
  r[2] += kappa * cd * w[1] * w[1] + 0.5 * d3 * w[0] * w[0];
  if (gravity_) {
    r[1] -= (kG2 + load_ * kG * kL1) * p.c2;
    r[2] -= (kG3 + load_ * kG * kL2) * p.s3;
  }

  const Vec3 tip = p.tip();
  const Vec3 v = p.tip_velocity(dq_);
  const double b = damping_ + hand.b;
  const Vec3 pull = bounded(hand.k * (intended - tip) + hand.b * hand.v + hand.force, kForceMax);
  r += p.joint_effort(pull - b * v);
  const double e = h * b + 0.25 * h * h * hand.k;
  a.a11 += e * p.rho * p.rho;
  a.a22 += e * kL1 * kL1;
  a.a33 += e * kL2 * kL2;
  a.a23 += e * kL1 * kL2 * sd;

  if (friction_[0] > 0.0) {
    const Vec3 secant = friction_.array() / (dq_.array().square() + friction_rate2_.array()).sqrt();
    r -= secant.cwiseProduct(dq_);
    a.a11 += h * secant[0];
    a.a22 += h * secant[1];
    a.a33 += h * secant[2];
  }
  if (near_stop(q_)) push_from_stops(q_, dq_, h, r, a);

  Vec3 change = h * a.solve(r);

  if (environment_.size() > 0) {
    constexpr std::size_t kMax = Environment::kSurfacesMax;
    std::array<ContactStep, kMax> contact;
    std::array<Vec3, kMax> row, response;  // normal velocity per dq; dq per impulse along the normal
    std::array<double, kMax> mobility{}, force{};
    bool any = false;
    for (std::size_t i = 0; i < environment_.size(); ++i) {
      const Surface& s = environment_[i];
      const double d = s.penetration(tip);
      if (d < -0.02) continue;  // farther than any motion within a substep
      Vec3 normal = Vec3::Zero();
      normal[s.axis] = s.sign;
      row[i] = p.joint_effort(normal);
      response[i] = a.solve(row[i]);
      mobility[i] = row[i].dot(response[i]);
      contact[i] = ContactStep(s, d, -s.sign * v[s.axis], -row[i].dot(change), mobility[i], h);
      any = any || contact[i].active;
    }
    // Projected Gauss-Seidel; with one surface the first sweep is exact.
    for (int sweep = 0; any && sweep < 4; ++sweep) {
      for (std::size_t i = 0; i < environment_.size(); ++i) {
        if (!contact[i].active) continue;
        const Vec3 others = change - h * force[i] * response[i];
        const double f = contact[i].force(-row[i].dot(others), mobility[i], h);
        change = others + h * f * response[i];
        force[i] = f;
      }
      if (environment_.size() == 1) break;
    }
    for (std::size_t i = 0; i < environment_.size(); ++i)
      f_environment_[environment_[i].axis] += environment_[i].sign * force[i];
  }

  Vec3 dq = dq_ + change;
  if (!dq.allFinite()) dq.setZero();
  // Values that decay without end would become denormal. Then a resting device would cost ten times as much as a moving
  // one.
  dq = (dq.array().abs() < kJointRateMin).select(0.0, dq);
  dq = dq.cwiseMax(-kRateMax).cwiseMin(kRateMax);
  f_hand_ += pull - hand.b * v;
  q_ += 0.5 * h * (dq_ + dq);
  dq_prev_ = dq_;
  dq_ = dq;
  for (int i = 0; i < 3; ++i) {
    const auto s = static_cast<std::size_t>(i);
    const double held = std::clamp(q_[i], kStopLow[s] - kStopSoft, kStopHigh[s] + kStopSoft);
    if (held != q_[i]) {
      q_[i] = held;
      dq_[i] = dq_prev_[i] = 0.0;
    }
  }
}

}  // namespace tandem::hal::sim
