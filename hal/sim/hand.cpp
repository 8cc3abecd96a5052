#include "hal/sim/hand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tandem::hal::sim {
namespace {

constexpr double kHoldK = 300.0, kHoldB = 10.0;          // [N/m, N s/m] while not engaged
constexpr double kFade = 0.5;                            // [s] fade between two impedances
constexpr double kApproach = 1.0;                        // [s] fade from the held pose to the intended motion
constexpr double kDeviationEdge = 0.1;                   // [s]
constexpr double kTremorFade = 0.5;                      // [s]
constexpr double kKeyboardSpeed = 0.3;                   // [m/s]
constexpr double kClockJump = 0.05, kClockExact = 1e-6;  // [s]
constexpr double kClockGain = 0.05;                      // share of a small clock difference that is closed per period
constexpr double kAtRest = 3e-6;                         // [m/s]; a circle has this speed 1.4 ms after its start

/// Returns the blend from the fixed point `from` to the moving `to`, with minimum jerk.
MotionPoint blend(const Vec3& from, const MotionPoint& to, double since, double length) noexcept {
  const MinJerk s = min_jerk(since / length);
  return {from + s.value * (to.x - from), s.value * to.v + s.rate / length * (to.x - from)};
}

Vec3 finite_or(const Vec3& v, const Vec3& otherwise) noexcept { return v.allFinite() ? v : otherwise; }

}  // namespace

KeyboardTarget::KeyboardTarget(const Vec3& start) noexcept : p_{start[0], start[1], start[2]} {}

void KeyboardTarget::set(const Vec3& position) noexcept {
  if (!position.allFinite()) return;
  for (std::size_t i = 0; i < 3; ++i) p_[i].store(position[static_cast<int>(i)], std::memory_order_relaxed);
}

Vec3 KeyboardTarget::get() const noexcept {
  return {p_[0].load(std::memory_order_relaxed), p_[1].load(std::memory_order_relaxed),
          p_[2].load(std::memory_order_relaxed)};
}

HandPull impedance_of(HandModel model) noexcept {
  HandPull p;
  p.m = 0.1;
  switch (model) {
    case HandModel::kNone:
      p.m = 0.0;
      break;
    case HandModel::kLeader:
    case HandModel::kLettingGo:
    case HandModel::kTremor:
    case HandModel::kRecorded:
      p.k = 1000.0, p.b = 10.0;
      break;
    case HandModel::kRelaxed:
      p.b = 2.0;
      break;
    case HandModel::kResting:
      p.k = 50.0, p.b = 5.0;
      break;
    case HandModel::kKeyboard:
      p.k = 300.0, p.b = 6.0;
      break;
  }
  return p;
}

Hand::Hand(const HandSpec& spec, const Vec3& start, std::shared_ptr<const RecordedMotion> motion)
    : spec_(spec),
      impedance_(impedance_of(spec.model)),
      motion_(std::move(motion)),
      keyboard_(std::make_shared<KeyboardTarget>(start)),
      session_(std::numeric_limits<double>::quiet_NaN()),
      hold_(start),
      tip_engaged_(start),
      key_{start, Vec3::Zero()} {
  if (spec.k > 0.0) impedance_.k = spec.k;
  if (spec.b > 0.0) impedance_.b = spec.b;
  if (spec.m > 0.0) impedance_.m = spec.m;
  if (moved_by_person(spec_.model)) {  // the scene's script does not apply to a hand that a user moves
    spec_.from = HandSpec{}.from;
    spec_.until = HandSpec{}.until;
  }
}

void Hand::set_session_time(std::optional<double> t) noexcept {
  session_.store(t && std::isfinite(*t) ? *t : std::numeric_limits<double>::quiet_NaN(), std::memory_order_relaxed);
}

void Hand::engage(double t, const Vec3& tip) noexcept {
  time_ = t;
  engaged_at_ = t;
  tip_engaged_ = tip;
  tip_own_ = tip;
  own_ = t >= spec_.from;
  from_blend_ = false;
  cursor_ = {};
  key_ = {hold_, Vec3::Zero()};
  const MotionPoint first = intended(t);
  approach_by_offset_ = first.v.norm() < kAtRest;
  approach_ = hold_ - first.x;
}

void Hand::follow_session(const Vec3& tip, double dt) noexcept {
  const double t = session_.load(std::memory_order_relaxed);
  if (std::isnan(t)) {
    if (time_) hold_ = tip;  // hold the present position, not the one at the session start
    time_.reset();
    return;
  }
  if (!time_) {
    engage(t, tip);
  } else if (t != session_seen_) {
    const double ahead = t - *time_;
    if (std::abs(ahead) > kClockJump + dt) {
      hold_ = tip;
      engage(t, tip);
    } else {
      *time_ = std::abs(ahead) < kClockExact ? t : *time_ + kClockGain * ahead;
    }
  }
  session_seen_ = t;
  if (!own_ && *time_ >= spec_.from) {
    own_ = from_blend_ = true;
    tip_own_ = tip;
    key_ = {tip, Vec3::Zero()};
  }
}

MotionPoint Hand::intended(double t) noexcept {
  switch (spec_.model) {
    case HandModel::kNone:
    case HandModel::kRelaxed:
      break;
    case HandModel::kResting:
      return {tip_own_, Vec3::Zero()};
    case HandModel::kLeader:
    case HandModel::kLettingGo:
      return at(spec_.trajectory, t);
    case HandModel::kKeyboard:
      return key_;
    case HandModel::kRecorded: {
      if (!motion_) break;
      MotionPoint p = motion_->at(t, cursor_);
      p.x += to_vec3(spec_.trajectory.center);
      return p;
    }
    case HandModel::kTremor: {
      MotionPoint p = at(spec_.trajectory, t);
      const MinJerk grow = min_jerk((t - engaged_at_) / kTremorFade);
      const double omega = 2.0 * std::numbers::pi * spec_.tremor_frequency;
      for (int i = 0; i < 3; ++i) {
        const double phase = omega * t + 2.0 * std::numbers::pi / 3.0 * i;
        const double s = spec_.tremor_amplitude * std::sin(phase);
        p.x[i] += grow.value * s;
        p.v[i] += grow.rate / kTremorFade * s + grow.value * spec_.tremor_amplitude * omega * std::cos(phase);
      }
      return p;
    }
  }
  return {hold_, Vec3::Zero()};
}

void Hand::move_keyboard(double dt) noexcept {
  if (!(dt > 0.0)) return;
  const Vec3 way = keyboard_->get() - key_.x;
  const double far = way.norm();
  const double step = std::min(far, kKeyboardSpeed * dt);
  const Vec3 moved = far > 0.0 ? Vec3(way * (step / far)) : Vec3(Vec3::Zero());
  key_.v = moved / dt;
  key_.x += moved;
}

Vec3 Hand::deviation(double t) const noexcept {
  Vec3 force = Vec3::Zero();
  for (const Deviation& d : spec_.deviations) {
    if (t <= d.at || t >= d.at + d.length) continue;
    const double edge = std::min(kDeviationEdge, 0.5 * d.length);
    force += min_jerk((t - d.at) / edge).value * min_jerk((d.at + d.length - t) / edge).value * to_vec3(d.force);
  }
  return force;
}

HandPull Hand::advance(const Vec3& tip, double dt) noexcept {
  HandPull pull;
  if (spec_.model == HandModel::kNone) return pull;
  const Vec3 here = finite_or(tip, hold_);
  follow_session(here, dt);
  if (!time_) {
    pull.k = kHoldK, pull.b = kHoldB, pull.m = impedance_.m;
    pull.x = hold_;
    return pull;
  }
  const double t = *time_ + 0.5 * dt;
  *time_ += dt;
  if (spec_.model == HandModel::kLettingGo && t >= spec_.release_at) {
    pull.force = to_vec3(spec_.drags);
    return pull;
  }

  MotionPoint p{hold_, Vec3::Zero()};
  if (own_) {
    if (spec_.model == HandModel::kKeyboard) move_keyboard(dt);
    p = intended(t);
    if (from_blend_) {
      p = blend(tip_own_, p, t - spec_.from, kFade);
    } else if (approach_by_offset_) {
      const MinJerk s = min_jerk((t - engaged_at_) / kApproach);
      p.x += (1.0 - s.value) * approach_;
      p.v -= s.rate / kApproach * approach_;
    } else {
      p = blend(hold_, p, t - engaged_at_, kApproach);
    }
  }

  // Sum of three impedances with fading shares: the holding one, the relaxed one and the model's own. The sum is again
  // one spring and one damper.
  const double engaged = min_jerk((t - engaged_at_) / kFade).value;
  const double begun = !own_ ? 0.0 : from_blend_ ? min_jerk((t - spec_.from) / kFade).value : 1.0;
  const double own = engaged * begun * (1.0 - min_jerk((t - spec_.until) / kFade).value);
  const double held = 1.0 - engaged;
  const double k_held = held * kHoldK, k_own = own * impedance_.k;
  const double b_own = own * impedance_.b;
  pull.m = impedance_.m;
  pull.k = k_held + k_own;
  pull.b = held * kHoldB + (engaged - own) * spec_.relaxed_b + b_own;
  pull.x = pull.k > 0.0 ? Vec3((k_held * hold_ + k_own * p.x) / pull.k) : p.x;
  pull.v = pull.b > 0.0 ? Vec3(b_own / pull.b * p.v) : p.v;
  pull.force = deviation(t);
  return pull;
}

}  // namespace tandem::hal::sim
