#include "hal/core/driver_guard.h"

#include <algorithm>
#include <cmath>

#include "hal/core/port_map.h"

namespace tandem::hal {
namespace {

/// Share of the peak force allowed while the force scale (counts to force) is not measured.
constexpr double kUncalibratedShare = 0.1;
/// Share of the motors' continuous heat limit above which the force limit decreases from the peak.
constexpr double kWarm = 0.8;

bool finite(const AxisArray& effort) noexcept {
  return std::all_of(effort.begin(), effort.end(), [](double e) { return std::isfinite(e); });
}

}  // namespace

double peak_of(const DeviceCaps& caps) noexcept {
  std::optional<double> peak;
  for (std::size_t i = 0; i < std::min<std::size_t>(caps.tip_axes, 3); ++i) {
    if (const auto& axis = caps.axis[i].peak) peak = std::min(peak.value_or(*axis), *axis);
  }
  return peak.value_or(0.0);
}

GuardLimits limits_of(const DeviceCaps& caps, MotorSigns signs) noexcept {
  GuardLimits limits;
  std::optional<double> continuous;
  for (std::size_t i = 0; i < std::min<std::size_t>(caps.tip_axes, 3); ++i) {
    if (const auto& axis = caps.axis[i].continuous) continuous = std::min(continuous.value_or(*axis), *axis);
  }
  double share = caps.force_calibrated ? 1.0 : kUncalibratedShare;
  if (caps.signs_from_file && signs == MotorSigns::kUnconfirmed) share = 0.0;
  // Confirmation uses pulses of 30 ms and measures the force scale together with the direction. The share is therefore
  // taken of the full peak.
  if (caps.signs_from_file && signs == MotorSigns::kBeingConfirmed) share = kConfirmingShare;
  limits.peak_n = share * peak_of(caps);
  if (continuous) limits.continuous_n = share * *continuous;
  return limits;
}

DriverGuard::DriverGuard(const GuardLimits& limits, std::size_t joints) noexcept
    : limits_(limits), joints_(std::min(joints, kAxesMax)) {}

void DriverGuard::start(Time now) noexcept {
  started_ = now;
  died_ = now;
  last_ = {};
  given_n_ = 0;
  implausible_ = 0;
}

void DriverGuard::observe(Time now, const State& state, bool continuous) noexcept {
  const bool finite_reading = state.x.allFinite() && state.dx.allFinite() && state.J.allFinite();
  const bool jumped = !finite_reading || (seen_ && continuous && (state.x - x_).norm() > limits_.jump_max_m);
  const bool fast = finite_reading && state.dx.norm() > limits_.speed_max_m_s;
  if (jumped || fast) ++implausible_;
  if (jumped || fast || !continuous) {
    started_ = now;  // the previous effort was computed for another position
    last_ = {};
  }
  seen_ = finite_reading;
  if (finite_reading) x_ = state.x;
  seen_at_ = now;
}

double DriverGuard::force_limit(Time now) const noexcept {
  const double continuous = std::min(limits_.continuous_n.value_or(limits_.peak_n), limits_.peak_n);
  const double stands = continuous * continuous;
  const double cool = stands > 0 ? std::clamp((1 - heat_ / stands) / (1 - kWarm), 0.0, 1.0) : 0.0;  // 1: cold, 0: hot
  const double by_heat = continuous + cool * (limits_.peak_n - continuous);
  const double begun = limits_.soft_start > Duration::zero()
                           ? std::clamp(seconds(now - started_) / seconds(limits_.soft_start), 0.0, 1.0)
                           : 1.0;
  return begun * by_heat;
}

DriverGuard::Output DriverGuard::limit(Time now, const Command& command, const State& state) noexcept {
  const double dt = passed_ ? std::clamp(seconds(now - passed_at_), 0.0, 1.0) : 0.0;
  if (command.seq != seq_ || command.expires != asked_) {  // the command arrived at the end of the previous step
    seq_ = command.seq;
    asked_ = command.expires;
    expires_ = std::min(command.expires, (passed_ ? passed_at_ : now) + kCommandLifetimeMax);
  }
  passed_ = true;
  passed_at_ = now;
  heat_ += (given_n_ * given_n_ - heat_) * -std::expm1(-dt / seconds(limits_.heat_time));

  Output out;
  const bool wanted = command.kind == CommandKind::kJointEffort;
  if (wanted && !finite(command.effort)) {
    out.verdict = Verdict::kNotFinite;
    last_ = {};
  } else if (wanted && now < expires_) {
    last_ = command.effort;
    std::fill(last_.begin() + static_cast<std::ptrdiff_t>(joints_), last_.end(), 0.0);
    died_ = expires_;
    out.effort = last_;
  } else {
    out.verdict = wanted ? Verdict::kExpired : Verdict::kPassed;
    const double left = wanted ? std::clamp(1 - seconds(now - died_) / seconds(limits_.fade_time), 0.0, 1.0) : 0.0;
    for (std::size_t i = 0; i < joints_; ++i) out.effort[i] = left * last_[i];
  }
  const double force = solve_tip_force(state.J, out.effort, joints_).norm();
  const double most = force_limit(now);
  given_n_ = force;
  if (!std::isfinite(force) || most <= 0 || !seen_) {
    if (force != 0 && out.verdict == Verdict::kPassed) out.verdict = Verdict::kInhibited;
    out.effort = {};
    given_n_ = 0;
  } else if (force > most) {
    for (double& e : out.effort) e *= most / force;
    given_n_ = most;
    if (out.verdict == Verdict::kPassed) out.verdict = Verdict::kClamped;
  }
  return out;
}

}  // namespace tandem::hal
