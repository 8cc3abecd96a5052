#include "hal/drivers/woodenhaptics/motors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tandem::hal::woodenhaptics {
namespace {

Vec3 finite_or_zero(const Vec3& v) noexcept { return v.allFinite() ? v : Vec3(Vec3::Zero()); }

}  // namespace

Motors::Motors(const WoodenHapticsSpec& spec) noexcept
    : wire_per_ampere_(1000.0 * spec.firmware_full_scale / spec.amplifier_full_scale) {
  for (std::size_t i = 0; i < 3; ++i) {
    current_per_effort_[static_cast<int>(i)] =
        spec.motor_direction[i] * spec.capstan[i] / spec.body[i] / spec.torque_constant[i];
  }
  const double limit = std::min(spec.current_max * wire_per_ampere_, 1000.0 * spec.firmware_full_scale);
  limit_ma_ =
      static_cast<int>(std::clamp(std::floor(limit + 1e-9), 0.0, double{std::numeric_limits<std::int16_t>::max()}));
}

MotorCommand Motors::to_command(const Vec3& effort, const Vec3& holding) const noexcept {
  const double limit = limit_ma_;
  const Vec3 exact_wish = wire_per_ampere_ * current_per_effort_.cwiseProduct(effort);
  const Vec3 wanted = finite_or_zero(exact_wish);
  const Vec3 hold = finite_or_zero(wire_per_ampere_ * current_per_effort_.cwiseProduct(finite_or_zero(holding)))
                        .cwiseMax(-limit)
                        .cwiseMin(limit);
  // Largest share of the commanded effort that fits beside the gravity compensation.
  double share = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double room = wanted[i] > 0.0 ? limit - hold[i] : limit + hold[i];
    if (std::abs(wanted[i]) > room) share = std::min(share, room / std::abs(wanted[i]));
  }
  MotorCommand out;
  for (int i = 0; i < 3; ++i) {
    const double exact = std::clamp(hold[i] + share * wanted[i], -limit, limit);
    out.current_ma[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(std::lround(exact));
  }
  out.saturated = share < 1.0 || !exact_wish.allFinite();
  out.effort = effort_of(out.current_ma) - hold.cwiseQuotient(wire_per_ampere_ * current_per_effort_);
  return out;
}

Vec3 Motors::effort_of(const std::array<std::int16_t, 3>& current_ma) const noexcept {
  return Vec3(current_ma[0], current_ma[1], current_ma[2]).cwiseQuotient(wire_per_ampere_ * current_per_effort_);
}

}  // namespace tandem::hal::woodenhaptics
