#include "common/control/plane_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/control/vector3.h"

namespace tandem::control {

namespace {

constexpr double kSmooth = 0.01;       // time constant of forces [s]
constexpr double kPersist = 0.02;      // a touch begins or ends after its condition held for this time [s]
constexpr double kForget = 0.5;        // of the sums [s]
constexpr double kSettle = 0.05;       // of the place and of the stiffness [s]
constexpr double kTurnTime = 0.2;      // of the normal [s]
constexpr double kTurnRate = 1;        // of the normal, largest [rad/s]
constexpr double kSlip = 0.02;         // velocity across the normal above which the force contains friction [m/s]
constexpr double kCorrelated = 0.005;  // samples nearer in time than this share one error [s]
constexpr double kSpread = 0.05;       // spread of forces below which they do not determine the stiffness [N]
constexpr double kTouchedMin = 0.05;   // [s]
constexpr double kHand = 1 / 400.0;    // compliance of a hand's spring [m/N]

double norm(const Vector3& v) noexcept { return std::sqrt(dot(v, v)); }
Vector3 scaled(const Vector3& v, double by) noexcept { return {v[0] * by, v[1] * by, v[2] * by}; }

}  // namespace

void PlaneEstimator::reset() noexcept {
  const std::uint32_t touches = touches_;
  *this = PlaneEstimator(axes_);
  touches_ = touches;
}

/// Ends the touch and discards what was learned about its surface.
void PlaneEstimator::leave() noexcept {
  const Vector3 force = force_, x = x_, v = v_, a = a_;
  reset();
  force_ = force;
  x_ = x;
  v_ = v;
  a_ = a;
  heard_ = true;
}

Vector3 PlaneEstimator::point() const noexcept {
  Vector3 out = origin_;
  for (std::size_t a = 0; a < out.size(); ++a) out[a] -= place_ * normal_[a];
  return out;
}

void PlaneEstimator::step(double dt, const Sample& sample) noexcept {
  double sum = dt;
  for (std::size_t a = 0; a < 3; ++a) sum += sample.x[a] + sample.v[a] + sample.f[a];
  if (!std::isfinite(sum) || !(dt > 0)) return;
  const double part = 1 - std::exp(-dt / kSmooth);
  if (!heard_) {
    x_ = sample.x;
    v_ = sample.v;
    force_ = sample.f;
  }
  heard_ = true;
  for (std::size_t a = 0; a < axes_; ++a) {  // equal filters keep the pairs of depth and force aligned
    force_[a] += part * (sample.f[a] - force_[a]);
    x_[a] += part * (sample.x[a] - x_[a]);
    const double before = v_[a];
    v_[a] += part * (sample.v[a] - v_[a]);
    a_[a] += part * ((v_[a] - before) / dt - a_[a]);
  }
  const double strength = norm(force_);
  if (state_ == State::kFree) {
    since_ = strength > kTouchForce + kTouchDrag * norm(v_) + kTouchMass * norm(a_) ? since_ + dt : 0;
    if (since_ >= kPersist) begin();
    return;
  }
  since_ = dot(force_, normal_) < kLeaveForce ? since_ + dt : 0;
  if (since_ >= kPersist) return leave();
  touched_ += dt;
  turn(dt, sample);
  double depth = 0;
  for (std::size_t a = 0; a < axes_; ++a) depth -= normal_[a] * (x_[a] - origin_[a]);
  regress(dt, depth, dot(force_, normal_));
  if (state_ == State::kTouching && touched_ >= kTouchedMin && uncertainty_ <= kUncertaintyMax) state_ = State::kKnown;
  if (state_ == State::kKnown && uncertainty_ > 2 * kUncertaintyMax) state_ = State::kTouching;
}

void PlaneEstimator::begin() noexcept {
  leave();
  ++touches_;
  state_ = State::kTouching;
  normal_ = scaled(force_, 1 / norm(force_));
  origin_ = x_;
  uncertainty_ = std::numeric_limits<double>::infinity();
}

void PlaneEstimator::turn(double dt, const Sample& sample) noexcept {
  const double strength = norm(force_), into = dot(sample.v, normal_);
  double slip = 0;
  for (std::size_t a = 0; a < axes_; ++a) slip += std::pow(sample.v[a] - into * normal_[a], 2);
  if (strength < kTouchForce || slip > kSlip * kSlip) return;
  Vector3 way{};
  for (std::size_t a = 0; a < axes_; ++a) way[a] = force_[a] / strength - normal_[a];
  const double angle = norm(way);
  if (angle == 0) return;
  const double step = std::min({angle * dt / kTurnTime, kTurnRate * dt, angle});
  for (std::size_t a = 0; a < axes_; ++a) normal_[a] += way[a] * step / angle;
  normal_ = scaled(normal_, 1 / norm(normal_));
}

/// Updates means, variances and covariance; older pairs count less.
void PlaneEstimator::regress(double dt, double depth, double force) noexcept {
  weight_ = std::min(weight_ + dt, kForget);
  const double part = dt / weight_, du = depth - mean_u_, dn = force - mean_n_;
  mean_u_ += part * du;
  mean_n_ += part * dn;
  const double rest = 1 - part;
  uu_ = rest * (uu_ + part * du * du);
  un_ = rest * (un_ + part * du * dn);
  nn_ = rest * (nn_ + part * dn * dn);
  const double settle = std::min(1.0, dt / std::min(kSettle, touched_));
  if (nn_ > kSpread * kSpread) {
    const double slope = un_ / nn_, left = std::max(0.0, uu_ - un_ * un_ / nn_);
    compliance_ += settle * (std::clamp(slope, 1 / kStiffnessMax, 1 / kStiffnessMin) - compliance_);
    const double pairs = std::max(1.0, weight_ / kCorrelated);
    uncertainty_ = std::sqrt(left / (nn_ * pairs)) / (compliance_ + kHand);
  }
  place_ += settle * (depth - compliance_ * force - place_);
}

}  // namespace tandem::control
