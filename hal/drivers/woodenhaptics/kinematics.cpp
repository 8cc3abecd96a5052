#include "hal/drivers/woodenhaptics/kinematics.h"

#include <cmath>
#include <numbers>

namespace tandem::hal::woodenhaptics {
namespace {

constexpr double kGravity = 9.80665;

int row(std::size_t i) noexcept { return static_cast<int>(i); }

}  // namespace

Kinematics::Kinematics(const WoodenHapticsSpec& spec) noexcept
    : height_(spec.link[0]),
      upper_(spec.link[1]),
      fore_(spec.link[2]),
      origin_(spec.origin[0], spec.origin[1], spec.origin[2]),
      weight_b_(kGravity * (spec.arm_mass[0] * spec.arm_mass_at[0] + spec.arm_mass[1] * spec.link[1])),
      weight_c_(kGravity * spec.arm_mass[1] * spec.arm_mass_at[1]) {
  for (std::size_t i = 0; i < 3; ++i) {
    angle_per_count_[row(i)] =
        spec.encoder_direction[i] * 2.0 * std::numbers::pi / spec.counts_per_turn * spec.capstan[i] / spec.body[i];
  }
}

Vec3 Kinematics::angles(const std::array<std::int32_t, 3>& counts) const noexcept {
  return angle_per_count_.cwiseProduct(Vec3(counts[0], counts[1], counts[2]));
}

Vec3 Kinematics::tip(const Vec3& q) const noexcept {
  const double rho = upper_ * std::sin(q[1]) + fore_ * std::sin(q[2]);
  return {std::sin(q[0]) * rho - origin_[1], origin_[0] - std::cos(q[0]) * rho,
          height_ + upper_ * std::cos(q[1]) - fore_ * std::cos(q[2]) - origin_[2]};
}

Eigen::Matrix3d Kinematics::jacobian(const Vec3& q) const noexcept {
  const double s = std::sin(q[0]), c = std::cos(q[0]);
  const double rho_b = upper_ * std::cos(q[1]), rho_c = fore_ * std::cos(q[2]);
  const double rise_b = upper_ * std::sin(q[1]), rise_c = fore_ * std::sin(q[2]);
  const double rho = rise_b + rise_c;
  Eigen::Matrix3d j;
  j << c * rho, s * rho_b, s * rho_c,   //
      s * rho, -c * rho_b, -c * rho_c,  //
      0.0, -rise_b, rise_c;
  return j;
}

std::optional<Vec3> Kinematics::inverse(const Vec3& tip) const noexcept {
  const double right = tip[0] + origin_[1], forward = origin_[0] - tip[1];
  const double rho = std::hypot(right, forward);
  const double rise = tip[2] + origin_[2] - height_;
  const double r = std::hypot(rho, rise);
  // The comparisons are also false for NaN.
  if (!(rho > 1e-6) || !(forward > 0.0) || !(r < 1e3)) return std::nullopt;
  const double cos_inner = (r * r + upper_ * upper_ - fore_ * fore_) / (2.0 * r * upper_);
  if (!(std::abs(cos_inner) <= 1.0)) return std::nullopt;
  const double b = std::atan2(rho, rise) - std::acos(cos_inner);
  const double c = std::atan2(rho - upper_ * std::sin(b), upper_ * std::cos(b) - rise);
  return Vec3(std::atan2(right, forward), b, c);
}

Vec3 Kinematics::holding_effort(const Vec3& q) const noexcept {
  return {0.0, -weight_b_ * std::sin(q[1]), weight_c_ * std::sin(q[2])};
}

double Kinematics::potential(const Vec3& q) const noexcept {
  return weight_b_ * std::cos(q[1]) - weight_c_ * std::cos(q[2]);
}

}  // namespace tandem::hal::woodenhaptics
