#include "hal/drivers/falcon/falcon_force.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/drivers/falcon/falcon_frame.h"
#include "hal/drivers/falcon/falcon_kinematics.h"

namespace tandem::hal {
namespace {

constexpr double kGravity = 9.80665;  // [m/s^2]
constexpr double kTorqueMin = 0.003;  // below this torque a reading does not determine the motor's scale [N m]
constexpr double kMisfitMax = 0.25;   // largest relative deviation of one reading from the fit
constexpr std::size_t kReadingsMin = 2;

std::string motor_name(std::size_t i) { return "motor " + std::to_string(i + 1); }
std::string reading_name(std::size_t i) { return "mass_reading " + std::to_string(i + 1); }

std::unexpected<FalconScaleError> wrong(std::string words, int line = 0) {
  return std::unexpected(FalconScaleError{.text = std::move(words), .line = line});
}

struct Load {
  Vec3 torque;
  Vec3 counts;
};

std::expected<Load, FalconScaleError> load_of(const FalconMassReading& r, std::size_t index) {
  Vec3 theta, counts;
  for (std::size_t i = 0; i < 3; ++i) {
    theta[static_cast<int>(i)] = kFalconZeroAngle + r.encoder[i] * kFalconRadPerCount;
    counts[static_cast<int>(i)] = r.motor_with[i] - r.motor_without[i];
  }
  const auto pose = falcon_forward(theta, Vec3::Zero());
  if (!pose) return wrong(reading_name(index) + ": a Falcon has no pose with these encoder counts", r.line);
  if (pose->condition > kConditionFull) {
    return wrong(reading_name(index) + ": too near the edge of the workspace; hold the grip in the middle", r.line);
  }
  const Vec3 up(r.up[0], r.up[1], r.up[2]);
  return Load{pose->J.transpose() * (r.mass * kGravity * up), counts};
}

}  // namespace

std::expected<std::array<double, 3>, FalconScaleError> fit_falcon_scale(
    const std::vector<FalconMassReading>& readings) {
  if (readings.size() < kReadingsMin) return wrong("needs at least two mass readings");
  std::vector<Load> loads;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    auto load = load_of(readings[i], i);
    if (!load) return std::unexpected(load.error());
    loads.push_back(*load);
  }
  std::array<double, 3> scale{};
  for (std::size_t m = 0; m < 3; ++m) {
    const int k = static_cast<int>(m);
    double torque2 = 0, product = 0;
    std::size_t used = 0;
    for (const Load& load : loads) {
      if (std::abs(load.torque[k]) < kTorqueMin) continue;
      ++used;
      torque2 += load.torque[k] * load.torque[k];
      product -= load.torque[k] * load.counts[k];  // positive counts pull the thigh in
    }
    if (used < kReadingsMin) {
      return wrong(motor_name(m) + " carries less than 3 mN m in all but " + std::to_string(used) +
                   " readings; use a larger mass or another direction of gravity");
    }
    scale[m] = product / torque2;
    if (!(scale[m] >= kFalconScaleMin && scale[m] <= kFalconScaleMax)) {
      return wrong(motor_name(m) + " comes out at " + std::to_string(scale[m]) +
                   " counts per N m; allowed is 500 to 100000. Is `up` the direction against gravity?");
    }
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const double expected = -scale[m] * loads[i].torque[k];
      if (std::abs(loads[i].torque[k]) < kTorqueMin) continue;
      if (std::abs(loads[i].counts[k] - expected) > kMisfitMax * std::abs(expected)) {
        return wrong(reading_name(i) + ": " + motor_name(m) + " gave " + std::to_string(loads[i].counts[k]) +
                         " counts, the other readings expect " + std::to_string(expected) +
                         "; more than 25 % apart. Repeat it, approaching from both sides",
                     readings[i].line);
      }
    }
  }
  return scale;
}

std::expected<FalconForce, FalconScaleError> FalconForce::from(const FalconSpec& spec) {
  FalconForce force;
  if (!spec.counts_per_nm && spec.readings.empty()) return force;
  if (spec.counts_per_nm) {
    force.scale_ = *spec.counts_per_nm;
  } else {
    const auto fitted = fit_falcon_scale(spec.readings);
    if (!fitted) return wrong(fitted.error().text, fitted.error().line != 0 ? fitted.error().line : spec.line);
    force.scale_ = *fitted;
  }
  for (const double scale : force.scale_) {
    if (!(scale >= kFalconScaleMin && scale <= kFalconScaleMax)) {
      return wrong("a motor has " + std::to_string(scale) + " counts per N m; allowed is 500 to 100000", spec.line);
    }
  }
  force.ceiling_ = kFalconMotorMax;
  force.calibrated_ = true;
  return force;
}

FalconForce::Sent FalconForce::counts_for(const Vec3& tau) const noexcept {
  Sent sent;
  if (!tau.allFinite()) {
    sent.saturated = true;
    return sent;
  }
  // Clamped before the conversion to an integer: the 16-bit field would wrap.
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    worst = std::max(worst, std::abs(tau[static_cast<int>(i)]) / torque_max(i));
  }
  sent.saturated = worst > 1;
  for (std::size_t i = 0; i < 3; ++i) {
    double share = tau[static_cast<int>(i)] / torque_max(i);
    if (sent.saturated) share /= worst;
    share = std::isfinite(share) ? std::clamp(share, -1.0, 1.0) : 0.0;
    sent.motor[i] = static_cast<std::int16_t>(-std::lround(share * ceiling_));
  }
  sent.tau = torque_of(sent.motor);
  return sent;
}

Vec3 FalconForce::torque_of(const std::array<std::int16_t, 3>& motor) const noexcept {
  Vec3 tau;
  for (std::size_t i = 0; i < 3; ++i) tau[static_cast<int>(i)] = -motor[i] / scale_[i];
  return tau;
}

}  // namespace tandem::hal
