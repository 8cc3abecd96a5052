#include "client/diagnostics/motor_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/format.h"
#include "hal/core/port_map.h"

namespace tandem::client {
namespace {

using Kind = DeviceDiagnostics::Finding::Kind;

/// Smallest delivered share of the commanded effort. A pulse below it is not evaluated.
constexpr double kGivenLeast = 0.5;

std::int32_t difference(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

}  // namespace

MotorCheck::MotorCheck(std::size_t joints, double peak, Time begin) noexcept
    : motors_(std::min(joints, kAxesMax)), peak_(peak), since_(begin) {
  if (motors_ == 0 || !(peak_ > 0)) phase_ = Phase::kOver;
}

/// Returns the encoder counts since the pulse began, positive if the joint moved in pulse direction.
int MotorCheck::moved_along(const hal::State& state) const noexcept {
  const int counts = std::abs(difference(state.raw[now_at_], from_raw_));
  const double way = state.q[now_at_] - from_q_;
  return (way > 0) == forward_ ? counts : -counts;
}

AxisArray MotorCheck::step(Time now, const hal::State& state) noexcept {
  AxisArray effort{};
  if (finished() || state.stale) return effort;  // a stale reading does not show motion
  if (!state.homed) {
    motor_[now_at_] = {.verdict = Verdict::kUnconfirmed, .reason = Reason::kNoForceLeft, .share = 0, .moved = {}};
    phase_ = Phase::kOver;
    return effort;
  }
  const std::int32_t raw = state.raw[now_at_];
  if (state.resynced && (phase_ == Phase::kPulsing || phase_ == Phase::kWatching)) {
    rest(now);  // positions may have jumped, so the pulse is repeated
    return effort;
  }
  switch (phase_) {
    case Phase::kWaiting:
      rest_low_ = rest_high_ = raw;
      if (now - since_ >= kSoftStart) rest(now);
      return effort;
    case Phase::kResting: {
      rest_low_ = std::min(rest_low_, raw);
      rest_high_ = std::max(rest_high_, raw);
      if (difference(rest_high_, rest_low_) > kRestCounts || state.resynced || rest_from_ == since_) {
        rest_low_ = rest_high_ = raw;
        rest_from_ = now;
      }
      if (now - rest_from_ < kRest) {
        if (now - since_ > kRestLimit) next_motor(now, Verdict::kUnconfirmed, Reason::kDidNotRest);
        return effort;
      }
      phase_ = Phase::kPulsing;
      since_ = now;
      from_raw_ = raw;
      from_q_ = state.q[now_at_];
      ordered_ = given_ = 0;
      motor_[now_at_].share = kShares[level_];
      break;
    }
    case Phase::kPulsing:
    case Phase::kWatching: {
      const int moved = moved_along(state);
      given_ = std::max(given_, std::abs(state.tau_out[now_at_]));
      motor_[now_at_].moved[forward_ ? 0 : 1] = moved;
      if (moved <= -kCounts) {
        motor_[now_at_].verdict = Verdict::kReversed;
        phase_ = Phase::kOver;
        return effort;
      }
      went_[forward_ ? 0 : 1] = went_[forward_ ? 0 : 1] || moved >= kCounts;
      if (phase_ == Phase::kWatching) {
        if (now - since_ >= kWatch) judge_pulse(now);
        return effort;
      }
      // The last command of a pulse acts until the next reading, so the pulse ends one period early.
      if (moved >= kCounts || now - since_ >= kPulse - std::chrono::milliseconds(1)) {
        end_pulse(now);
        return effort;
      }
      break;
    }
    case Phase::kOver:
      return effort;
  }
  AxisArray unit{};
  unit[now_at_] = 1.0;
  const double per_effort = hal::solve_tip_force(state.J, unit, motors_).norm();  // [N] at the tip
  if (!std::isfinite(per_effort) || !(per_effort > 0)) {
    next_motor(now, Verdict::kUnconfirmed, Reason::kNoForceLeft);
    return effort;
  }
  effort[now_at_] = (forward_ ? 1.0 : -1.0) * kShares[level_] * peak_ / per_effort;
  ordered_ = std::max(ordered_, std::abs(effort[now_at_]));
  return effort;
}

void MotorCheck::rest(Time now) noexcept {
  phase_ = Phase::kResting;
  since_ = rest_from_ = now;
}

void MotorCheck::end_pulse(Time now) noexcept {
  phase_ = Phase::kWatching;
  since_ = now;
}

void MotorCheck::judge_pulse(Time now) noexcept {
  if (given_ < kGivenLeast * ordered_) {
    // The guard restarted its soft start, as it does after a stall of this program. The pulse is repeated after the
    // soft start.
    if (++weak_ > kWeakMax) return next_motor(now, Verdict::kUnconfirmed, Reason::kNoForceLeft);
    phase_ = Phase::kWaiting;
    since_ = now;
    return;
  }
  if (forward_) {
    forward_ = false;
    return rest(now);
  }
  forward_ = true;
  const bool both = went_[0] && went_[1], one = went_[0] != went_[1];
  if (both) return next_motor(now, Verdict::kRight, Reason::kNone);
  if (++level_ == kShares.size())
    return next_motor(now, Verdict::kUnconfirmed, one ? Reason::kOneWayOnly : Reason::kDidNotMove);
  went_ = {};
  rest(now);
}

void MotorCheck::next_motor(Time now, Verdict verdict, Reason why) noexcept {
  motor_[now_at_].verdict = verdict;
  motor_[now_at_].reason = why;
  ++now_at_;
  level_ = 0;
  weak_ = 0;
  forward_ = true;
  went_ = {};
  if (now_at_ >= motors_) {
    now_at_ = motors_ - 1;
    phase_ = Phase::kOver;
  } else {
    rest(now);
  }
}

bool MotorCheck::all_right() const noexcept {
  return motors_ > 0 && std::all_of(motor_.begin(), motor_.begin() + static_cast<std::ptrdiff_t>(motors_),
                                    [](const Motor& m) { return m.verdict == Verdict::kRight; });
}

std::vector<DeviceDiagnostics::Finding> MotorCheck::findings(const std::vector<std::string>& names) const {
  std::vector<DeviceDiagnostics::Finding> all;
  if (motors_ == 0 || !(peak_ > 0))
    all.push_back({Kind::kTrouble, "the device does not report the forces of its motors: there is nothing to confirm"});
  for (std::size_t i = 0; i < motors_ && peak_ > 0; ++i) {
    const Motor& m = motor_[i];
    const std::string name = i < names.size() ? names[i] : "motor " + std::to_string(i + 1);
    const std::string seen = format("pulses of %.0f %% of the peak moved it by %d and %d counts the way they pushed",
                                    100 * m.share, m.moved[0], m.moved[1]);
    switch (m.verdict) {
      case Verdict::kRight:
        all.push_back({Kind::kGood, name + ": pushes in the commanded direction (" + seen + ")"});
        break;
      case Verdict::kReversed:
        all.push_back(
            {Kind::kTrouble,
             name + ": moved AGAINST its command, so all motors were switched off (" + seen +
                 "). Invert its motor_reversed in the device's file (write `motor_reversed: true`, or take it out if "
                 "it is there), and confirm again. If your hand moved the arm, only confirm again"});
        break;
      case Verdict::kUnconfirmed: {
        const char* const why =
            m.reason == Reason::kDidNotRest
                ? "the arm did not rest for 60 ms within 3 s: support it so that it stays where it is, loosely"
            : m.reason == Reason::kNoForceLeft
                ? "hardly any force left this program: the device lost its origin, or the arm is stretched; bring "
                  "it into the middle of its workspace"
            : m.reason == Reason::kOneWayOnly
                ? "it moved one way only: it is at a stop, or presses against the hand; bring it into the middle"
                : "it did not move: jammed, held fast, or the motors have no power";
        all.push_back(
            {Kind::kTrouble, name + ": unconfirmed, " + why + (m.share > 0 ? " (" + seen + ")" : std::string())});
        break;
      }
      case Verdict::kUntested:
        all.push_back({Kind::kNotice, name + ": not tested, as the check ended before its turn"});
        break;
    }
  }
  return all;
}

}  // namespace tandem::client
