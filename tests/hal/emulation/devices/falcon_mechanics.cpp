#include "tests/hal/emulation/devices/falcon_mechanics.h"

#include <cmath>

namespace tandem::hal::emulation {
namespace {

constexpr double kGravity = 9.80665;     // [m/s^2]
constexpr double kFrictionSpeed = 1e-3;  // [m/s]
constexpr double kConditionStop = 40;    // condition from which on the stops hold the tip, near a singular pose

bool within_stops(const Vec3& theta) {
  return theta.minCoeff() >= kFalconAngleMin && theta.maxCoeff() <= kFalconAngleMax;
}

}  // namespace

FalconMechanics::FalconMechanics(const FalconMechanicsSpec& spec) noexcept : spec_(spec) {
  const auto pose = falcon_pose_at(spec.start);
  pose_ = pose ? *pose : *falcon_pose_at(Vec3::Zero());
  theta_ = *falcon_inverse(pose_.x);
  pull_.x = pose_.x;
  lose_origin();
}

void FalconMechanics::advance(const std::array<std::int16_t, 3>& motor, double dt) noexcept {
  Vec3 tau;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    tau[i] = -motor[k] / spec_.counts_per_nm[k];
  }
  motor_force_ = pose_.J_inv.transpose() * tau;
  const double mass = spec_.mass + spec_.load + pull_.m;
  Vec3 force = motor_force_ + pull_.force + pull_.k * (pull_.x + dt * pull_.v - pose_.x) + pull_.b * pull_.v;
  force -= kGravity * spec_.load * spec_.up;
  // Coulomb friction as the damper with the same force at the present speed: it never reverses the motion.
  const double rub = spec_.friction / std::sqrt(v_.squaredNorm() + kFrictionSpeed * kFrictionSpeed);
  const double held = mass + dt * (spec_.damping + pull_.b + rub) + dt * dt * pull_.k;
  v_ = (mass * v_ + dt * force) / held;
  pull_.x += dt * pull_.v;

  const Vec3 next = pose_.x + dt * v_;
  const auto pose = falcon_pose_at(next);
  const auto theta = falcon_inverse(next);
  if (!pose || !theta || !within_stops(*theta) || pose->condition > kConditionStop) {
    v_.setZero();
    return;
  }
  pose_ = *pose;
  theta_ = *theta;
}

std::array<std::int32_t, 3> FalconMechanics::true_counts() const noexcept {
  std::array<std::int32_t, 3> counts{};
  for (int i = 0; i < 3; ++i) {
    counts[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::lround((theta_[i] - kFalconZeroAngle) / kFalconRadPerCount));
  }
  return counts;
}

void FalconMechanics::lose_origin() noexcept { offset_ = true_counts(); }

std::array<std::int16_t, 3> FalconMechanics::encoder() const noexcept {
  const auto counts = true_counts();
  std::array<std::int16_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = static_cast<std::int16_t>(counts[i] - offset_[i]);
  return out;
}

}  // namespace tandem::hal::emulation
