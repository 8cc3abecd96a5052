#include "hal/core/servo_core.h"

#include <algorithm>
#include <utility>

namespace tandem::hal {
namespace {

/// Implausible readings tolerated since the forces were enabled. More of them lead to Fault.
constexpr std::uint64_t kImplausibleMax = 3;
/// Largest part of the miss limit that one unanswered exchange uses up: two periods of an ordinary servo.
constexpr Duration kAskedMost = std::chrono::milliseconds(2);
/// A gap between steps of this length is a stall: the program was stopped or starved. A WatchdogProcess has sent zero
/// frames meanwhile.
constexpr Duration kStallLimit = std::chrono::milliseconds(20);

Result<> bad_state(const DeviceId& id, const char* what) {
  return std::unexpected(DeviceError{Errc::kBadState, id.backend + " " + id.key + ": " + what});
}

}  // namespace

ServoCore::ServoCore(std::unique_ptr<Driver> driver, std::optional<GuardLimits> limits)
    : driver_(std::move(driver)), asked_(limits) {}

ServoCore::ServoCore(std::unique_ptr<Driver> driver, MotorSigns signs) : driver_(std::move(driver)), signs_(signs) {}

Result<> ServoCore::bring_up(BringUp& watcher) {
  phase_.store(Phase::kOpening);
  phase_.store(Phase::kBooting);
  if (auto up = driver_->bring_up(watcher); !up) {
    phase_.store(up.error().code == Errc::kUnplugged ? Phase::kLost : Phase::kFault);
    return up;
  }
  phase_.store(Phase::kIdentified);
  limits_ = asked_.value_or(limits_of(caps(), signs_));
  guard_ = DriverGuard{limits_, caps().joints};
  stepped_ = false;
  phase_.store(caps().homing == Homing::kNone ? Phase::kReady : Phase::kUnhomed);
  return {};
}

bool ServoCore::step(Time now, ServoClient& client) noexcept {
  const Phase phase = this->phase();
  if (phase == Phase::kLost || phase == Phase::kAbsent) return false;
  if (phase == Phase::kBooting) return true;
  const bool stalled = stepped_ && now - stepped_at_ >= kStallLimit;
  if (!stepped_) asked_at_ = now, silent_for_ = {};
  if (phase == Phase::kEnabled && (acted_ != Phase::kEnabled || stalled)) guard_.start(now);
  stepped_ = true;
  stepped_at_ = now;
  acted_ = phase;

  ServoCommand command;
  command.homing = phase == Phase::kUnhomed;
  if (phase == Phase::kEnabled) {
    const DriverGuard::Output out = guard_.limit(now, command_, state_);
    command.effort = out.effort;
    command.seq = command_.seq;
    using Verdict = DriverGuard::Verdict;
    stats_.expired += out.verdict == Verdict::kExpired ? 1 : 0;
    stats_.rejected += out.verdict == Verdict::kNotFinite ? 1 : 0;
    stats_.clamped += out.verdict == Verdict::kClamped || out.verdict == Verdict::kInhibited ? 1 : 0;
  }
  state_.stale = false;  // a driver of a device that sends only on motion sets this itself
  const auto exchanged = driver_->exchange(command, state_);
  ++stats_.ticks;
  if (!exchanged && exchanged.error() == Errc::kUnplugged) {
    phase_.store(Phase::kLost, std::memory_order_release);
    client.lost(Errc::kUnplugged);
    return false;
  }
  if (!exchanged && exchanged.error() == Errc::kFirmware) phase_.store(Phase::kBooting);
  check_response(now, exchanged.value_or(Exchange::kNothing));
  follow_homing(this->phase(), now);
  command_ = client.tick(state_);
  return true;
}

void ServoCore::check_response(Time now, Exchange how) noexcept {
  if (how == Exchange::kNothing) {
    ++stats_.unanswered;
    state_.stale = true;
    state_.sampled_at = now;
    // A stalled host sent no frames. Its own delay does not count as missing replies of the device.
    silent_for_ += std::min(now - asked_at_, kAskedMost);
    asked_at_ = now;
    if (silent_for_ < limits_.miss_limit) return;
    // From here on only zeros are sent. The device's behaviour is unknown, so only the user can resume, by `reset`.
    for (const Phase from : {Phase::kEnabled, Phase::kReady, Phase::kUnhomed}) change(from, Phase::kFault);
    return;
  }
  silent_for_ = {};
  asked_at_ = now;
  state_.resynced = how == Exchange::kResynced;
  stats_.resyncs += state_.resynced ? 1 : 0;
  guard_.observe(now, state_, !state_.resynced);
  if (guard_.implausible() > kImplausibleMax) change(Phase::kEnabled, Phase::kFault);
}

void ServoCore::follow_homing(Phase phase, Time now) noexcept {
  if (phase == Phase::kUnhomed && state_.homed && !state_.stale) {
    guard_.observe(now, state_, false);  // the origin has changed
    change(Phase::kUnhomed, Phase::kReady);
  } else if (!state_.homed) {
    for (const Phase from : {Phase::kEnabled, Phase::kReady}) change(from, Phase::kUnhomed);
  }
}

Result<> ServoCore::enable() {
  if (change(Phase::kReady, Phase::kEnabled)) return {};
  switch (phase()) {
    case Phase::kEnabled:
      return {};
    case Phase::kUnhomed:
      return std::unexpected(
          DeviceError{Errc::kNotHomed, id().backend + " " + id().key + ": has no position reference; home it first"});
    case Phase::kFault:
      return bad_state(id(), "had a fault; reset it first");
    case Phase::kLost:
      return bad_state(id(), "is lost; plug it in and open it again");
    default:
      return bad_state(id(), "is not ready yet");
  }
}

void ServoCore::disable() noexcept { change(Phase::kEnabled, Phase::kReady); }

Result<> ServoCore::reset() {
  switch (phase()) {
    case Phase::kReady:
    case Phase::kEnabled:
    case Phase::kUnhomed:
      return {};
    case Phase::kFault:
      // The next reading shows whether the device is still homed; therefore the phase passes through Unhomed.
      change(Phase::kFault, Phase::kUnhomed);
      return {};
    default:
      return bad_state(id(), "is lost or not open; open it again");
  }
}

}  // namespace tandem::hal
