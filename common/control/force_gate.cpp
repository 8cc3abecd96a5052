#include "common/control/force_gate.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

namespace {

using namespace std::chrono_literals;

constexpr Duration kDampOut = 500ms;  // duration of damping alone after the link is lost
constexpr Duration kMargin = 20ms;    // a loop may exceed its learned p99 by this much
constexpr double kAgeSlew = 0.010;    // the limit follows the learned RTT by at most 10 ms per s
constexpr double kSlewActive = 1000;  // [N/s] = 1 N/ms
constexpr double kSlewRampIn = 10;    // [N/s]
constexpr double kDamping = 5;        // [N s/m] in kReleasing and kLatched

bool all_finite(const AxisArray& v, std::size_t dof) noexcept {
  for (std::size_t a = 0; a < dof; ++a)
    if (!std::isfinite(v[a])) return false;
  return true;
}

}  // namespace

ForceGate::ForceGate(const GateParams& p) noexcept
    : p_(p), tank_({.dof = p.dof, .scale = p.scale, .mass = p.mass, .share = p.tank_share}) {}

ForceGate::Output ForceGate::step(const Input& in) noexcept {
  Output out;
  if (!started_) {
    started_ = true;
    since_ = last_fresh_ = last_step_ = in.now;
    age_limit_ = std::min(p_.loop_age_max, std::max(kMargin, in.rtt_p99 + kMargin));
    tank_.start_at(in.q);
  }
  // After a standstill of this program the device had dropped the effort long before. The energy given may be less than
  // effort times motion, and energy that the hand seemed to return was never absorbed.
  tank_.measure(effort_, in.q, in.now - last_step_ <= p_.command_lifetime);
  // The driver has dropped the effort: no ramp begins from it.
  if (in.now - last_step_ > p_.command_lifetime + kCommandFade) effort_.fill(0);
  const double step = std::clamp(seconds(in.now - last_step_), 0.0, seconds(p_.command_lifetime));
  tank_.set_pace(step);
  change_phase(in, out);
  if (phase_ == GatePhase::kReleasing || phase_ == GatePhase::kLatched || active()) tank_.note_loss();
  limit(in, out);
  effort_ = out.effort;
  last_step_ = in.now;
  return out;
}

void ForceGate::change_phase(const Input& in, Output& out) noexcept {
  renewed_ = false;
  if (!in.reading_valid) {
    phase_ = GatePhase::kFault;  // untrusted sensors: motors stay off until the participant resets
    return;
  }
  // Before engaging, the limit follows the learned value freely. With a hand engaged it follows slowly, because
  // otherwise a slow attacker could raise it.
  const Duration learned = std::min(p_.loop_age_max, std::max(kMargin, in.rtt_p99 + kMargin));
  if (active()) {
    const Duration step =
        from_seconds(kAgeSlew * std::max(0.0, seconds(in.now - last_step_)));  // a clock may step back
    age_limit_ += std::clamp(learned - age_limit_, -step, step);
  } else {
    age_limit_ = learned;
  }

  silence_limit_ = std::max(p_.silence_limit, in.silence_allowance);
  const bool too_old = in.loop_age > age_limit_ + in.silence_allowance;
  // The allowance covers a silent network, not a program that stood still. Its device dropped the force meanwhile, and
  // the force would return at once.
  const bool stood_still = in.silence_allowance > Duration::zero() && in.now - last_step_ >= p_.silence_limit;
  renewed_ = in.fresh && !too_old;
  if (renewed_) {
    last_fresh_ = in.now;
    heard_ = true;
    // A ramp that has begun or begins now still holds the stale force. Its account closes when the gate engages again,
    // not with the next datagram.
    if (phase_ != GatePhase::kReleasing && phase_ != GatePhase::kLatched && !stood_still) tank_.refill();
  }
  const bool silent = in.now - last_fresh_ >= silence_limit_ || !heard_ || stood_still;

  switch (phase_) {
    case GatePhase::kOff:
    case GatePhase::kZero:
      if (in.engage && in.fresh && !silent && !too_old) {
        phase_ = GatePhase::kRampIn;
        since_ = in.now;
        tank_.refill();
        out.engaged_now = true;
      }
      break;
    case GatePhase::kRampIn:
      if (in.now - since_ >= p_.ramp_in) phase_ = GatePhase::kActive;
      [[fallthrough]];
    case GatePhase::kActive:
      if (silent || too_old) {
        lose(in, out);
      } else if (!in.engage) {  // requested release: the same ramp, but not counted as a loss
        phase_ = GatePhase::kReleasing;
        since_ = in.now;
        ramp_.begin(in.now, effort_);
      }
      break;
    case GatePhase::kReleasing:
      // Damping stays until the seat may engage again or the hand has come to rest: the hand is fastest when the ramp
      // ends.
      if (in.now - since_ >= (renewed_ && in.engage ? ReleaseRamp::kTime : kDampOut)) phase_ = GatePhase::kZero;
      break;
    case GatePhase::kLatched:
    case GatePhase::kFault:
      if (in.reset) phase_ = GatePhase::kZero;
      break;
  }
}

void ForceGate::lose(const Input& in, Output& out) noexcept {
  out.tripped = true;
  phase_ = GatePhase::kReleasing;
  since_ = in.now;
  // A client that wakes up late notices the silence late. The ramp begins at the time the limit passed, so that it ends
  // in time.
  ramp_.begin(std::min(in.now, std::max(last_step_, last_fresh_ + silence_limit_)), effort_);
  if (losses_.record(in.now) && p_.latch) phase_ = GatePhase::kLatched;
}

double ForceGate::gain_of_ramp(Time now) const noexcept {
  if (phase_ != GatePhase::kRampIn) return 1;
  return std::min(1.0, seconds(now - since_) / std::max(1e-3, seconds(p_.ramp_in)));
}

void ForceGate::limit(const Input& in, Output& out) noexcept {
  AxisArray& f = out.effort;
  const double dt = std::clamp(seconds(in.now - last_step_), 0.0, 0.01);

  if (active()) {
    if (!all_finite(in.wanted, p_.dof)) {
      out.not_finite = true;
      ++not_finite_;
      return;  // zero
    }
    const double gain = gain_of_ramp(in.now);
    // Damping replaces what the growing spring does not hold yet, so that a hand that is moving at engagement is slowed
    // and not accelerated.
    for (std::size_t a = 0; a < p_.dof; ++a)
      f[a] = gain * in.wanted[a] - (std::isfinite(in.v[a]) ? (1.0 - gain) * kDamping * p_.scale[a] * in.v[a] : 0.0);
  } else if (phase_ == GatePhase::kReleasing || phase_ == GatePhase::kLatched) {
    const double left = ramp_.left(in.now);
    for (std::size_t a = 0; a < p_.dof; ++a) {
      const double v = std::isfinite(in.v[a]) ? in.v[a] : 0;
      f[a] = left * ramp_.from(a) - kDamping * p_.scale[a] * v * (phase_ == GatePhase::kLatched ? 1.0 : 1.0 - left);
    }
  } else {
    return;
  }

  // Clamp the norm at the tip; the direction stays.
  double norm2 = 0;
  for (std::size_t a = 0; a < p_.dof; ++a) norm2 += f[a] * f[a] / p_.scale[a];
  if (!std::isfinite(norm2)) {  // finite numbers whose square overflows
    f.fill(0);
    out.not_finite = true;
    ++not_finite_;
    return;
  }
  if (norm2 > p_.force_max * p_.force_max) {
    const double shrink = p_.force_max / std::sqrt(norm2);
    for (std::size_t a = 0; a < p_.dof; ++a) f[a] *= shrink;
    out.clipped = true;
  }
  if (active()) {  // along the straight line from the last effort, so that the limit of the norm holds in between
    double change2 = 0;
    for (std::size_t a = 0; a < p_.dof; ++a) change2 += (f[a] - effort_[a]) * (f[a] - effort_[a]) / p_.scale[a];
    const double step = (phase_ == GatePhase::kRampIn ? kSlewRampIn : kSlewActive) * dt;
    if (change2 > step * step) {
      const double share = step / std::sqrt(change2);
      for (std::size_t a = 0; a < p_.dof; ++a) {
        const double left = (1 - share) * (f[a] - effort_[a]), whole = gain_of_ramp(in.now) * in.wanted[a];
        if (phase_ == GatePhase::kRampIn && left * whole > 0) out.held_back[a] = std::min(1.0, left / whole);
        f[a] = effort_[a] + share * (f[a] - effort_[a]);
      }
    }
  }
  if ((!renewed_ || phase_ == GatePhase::kReleasing) && !tank_.allows(f, in.v)) f.fill(0);
}

}  // namespace tandem::control
