#include "hal/sim/linear_plant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/sim/touch_plant.h"

namespace tandem::hal::sim {
namespace {

constexpr double kHandForceMax = 1000.0, kTravelMax = 10.0, kSpeedMax = 100.0, kSpeedMin = 1e-30;

double bounded(double v) noexcept { return std::isfinite(v) ? std::clamp(v, -kHandForceMax, kHandForceMax) : 0.0; }

}  // namespace

LinearPlant::LinearPlant(const SimDeviceSpec& spec, const EnvironmentSpec& environment, const Vec3& start) noexcept
    : environment_(environment),
      mass_(spec.mass + spec.load),
      friction_(spec.friction),
      damping_(spec.damping),
      tip_(start) {}

double LinearPlant::penetration() const noexcept {
  double deepest = 0.0;
  for (std::size_t i = 0; i < environment_.size(); ++i) {
    if (environment_[i].axis == 0) deepest = std::max(deepest, environment_[i].penetration(tip_));
  }
  return deepest;
}

void LinearPlant::set(double x, double v) noexcept {
  tip_[0] = x;
  v_ = v;
}

void LinearPlant::advance(const Vec3& tau, const HandPull& hand, double dt) noexcept {
  if (!(dt > 0.0)) return;
  dt = std::min(dt, 1.0);
  const int n = std::max(1, static_cast<int>(std::ceil(dt / kSubstepMax - 1e-6)));
  const double h = dt / n;
  const double force = bounded(tau[0]);
  f_environment_.setZero();
  f_hand_.setZero();
  double intended = hand.x[0] - (0.5 * dt - 0.5 * h) * hand.v[0];
  for (int i = 0; i < n; ++i) {
    substep(force, hand, intended, h);
    intended += h * hand.v[0];
  }
  f_environment_ /= n;
  f_hand_ /= n;
}

void LinearPlant::substep(double force, const HandPull& hand, double intended, double h) noexcept {
  Vec3 middle = tip_;
  middle[0] += 0.5 * h * v_;
  const double b = damping_ + hand.b;
  const double pull = bounded(hand.k * (intended - middle[0]) + hand.b * hand.v[0] + hand.force[0]);
  const double secant = friction_ / std::sqrt(v_ * v_ + kFrictionSpeed * kFrictionSpeed);
  const double inv = 1.0 / (mass_ + hand.m + h * (b + secant) + 0.25 * h * h * hand.k);
  double change = h * inv * (force + pull - (b + secant) * v_);

  std::array<ContactStep, Environment::kSurfacesMax> contact;
  std::array<double, Environment::kSurfacesMax> push{};
  for (std::size_t i = 0; i < environment_.size(); ++i) {
    const Surface& s = environment_[i];
    if (s.axis != 0) continue;
    contact[i] = ContactStep(s, s.penetration(middle), -s.sign * v_, -s.sign * change, inv, h);
  }
  // Two surfaces may face each other or be one behind the other. The sweeps converge because each single solution is
  // exact.
  for (int sweep = 0; sweep < 8; ++sweep) {
    for (std::size_t i = 0; i < environment_.size(); ++i) {
      if (!contact[i].active) continue;
      const double sign = environment_[i].sign;
      const double others = change - h * inv * sign * push[i];
      push[i] = contact[i].force(-sign * others, inv, h);
      change = others + h * inv * sign * push[i];
    }
    if (environment_.size() < 2) break;
  }
  for (std::size_t i = 0; i < environment_.size(); ++i) f_environment_[0] += environment_[i].sign * push[i];

  double v = v_ + change;
  if (!std::isfinite(v) || std::abs(v) < kSpeedMin) v = 0.0;  // also avoids denormal numbers
  v = std::clamp(v, -kSpeedMax, kSpeedMax);
  f_hand_[0] += pull - hand.b * v_;
  tip_[0] += 0.5 * h * (v_ + v);
  v_ = v;
  if (std::abs(tip_[0]) > kTravelMax) {
    tip_[0] = std::clamp(tip_[0], -kTravelMax, kTravelMax);
    v_ = 0.0;
  }
}

}  // namespace tandem::hal::sim
