#include "client/app/keyboard_controls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::client {

namespace {
constexpr double kAlphaStep = 0.05;
constexpr double kHandStep = 0.005;  // [m] per key
constexpr double kHandReach = 0.06;  // [m] largest distance from the start, per axis
}  // namespace

KeyboardControls::KeyboardControls(UserCommands& commands, const SeatSetup& setup,
                                   std::shared_ptr<hal::sim::KeyboardTarget> keyboard)
    : commands_(&commands), setup_(&setup), keyboard_(std::move(keyboard)) {
  if (keyboard_) home_ = keyboard_->get();
  // Authority that the user gives up goes in equal shares to all other masters that may have authority.
  double drivers = 0;
  for (std::size_t i = 0; i < setup.masters.size(); ++i) {
    const bool other = i != setup.own_master && (setup.driver_mask >> i & 1) != 0;
    others_[i] = other ? 1 : 0;
    drivers += others_[i];
  }
  for (double& share : others_) share /= std::max(1.0, drivers);
}

std::string KeyboardControls::help() const {
  std::string text = "keys:";
  if (may_change_authority())
    text += keyboard_ ? " a/d less/more authority for you, 0/1 none/all;"
                      : " left/right less/more authority for you, 0/1 none/all;";
  if (keyboard_) text += " arrows move right/left and away/towards you, PgUp/PgDn up/down;";
  return text + " s stops your hand, S all hands" + (setup_->seat.role == Role::kInstructor ? "" : " (pause)") +
         ", r resumes; b clears a force that is latched off; ? shows this; q leaves";
}

std::optional<std::array<double, 3>> KeyboardControls::keys() const {
  if (!keyboard_) return std::nullopt;
  const hal::Vec3 from_home = keyboard_->get() - home_;
  return std::array{from_home[0], from_home[1], from_home[2]};
}

KeyboardControls::KeyResult KeyboardControls::on_key(const std::string& key, const ClientStatus& status,
                                                     const rpc::Status* words) {
  if (key == "q" || key == "Q" || key == "\x04") return {true, {}};
  if (key == "?" || key == "h") return {false, help()};
  if (key == "b") return {false, reset(status)};
  if (key == "s" || key == " ") {
    commands_->stop();
    return {false, status.local_stop ? "s: your hand is stopped already; r resumes" : ""};
  }
  if (key == "S") return {false, stop_all(status)};
  if (key == "r") return {false, resume(status, words)};
  if (keyboard_) {
    if (key == "right") return {false, move_hand(0, kHandStep, status)};
    if (key == "left") return {false, move_hand(0, -kHandStep, status)};
    if (key == "up") return {false, move_hand(1, kHandStep, status)};
    if (key == "down") return {false, move_hand(1, -kHandStep, status)};
    if (key == "pageup") return {false, move_hand(2, kHandStep, status)};
    if (key == "pagedown") return {false, move_hand(2, -kHandStep, status)};
  }
  return {false, change_authority(key, status)};
}

std::string KeyboardControls::reset(const ClientStatus& s) {
  const bool waits = s.gate == wire::GateState::kLatched || s.gate == wire::GateState::kFault || s.motors.latched;
  commands_->reset_gate();
  return waits          ? ""
         : s.motors.hot ? "b: the motors are too hot; take your hand off until they are cool"
                        : "b: nothing is latched off, there is nothing to clear";
}

std::string KeyboardControls::stop_all(const ClientStatus& s) {
  if (setup_->seat.role == Role::kObserver)
    return "S: an observer may not stop the session; an instructor or operator may";
  if (setup_->seat.kind == SeatKind::kSlave) return "S: a slave's seat may not stop the session; s stops this device";
  commands_->stop_all();
  return s.session == wire::SessionState::kStopped ? "S: the session is stopped already" : "";
}

/// Requests a resume. If the server would reject it, returns the reason.
std::string KeyboardControls::resume(const ClientStatus& s, const rpc::Status* words) {
  commands_->resume();
  if (s.local_stop) return {};
  const bool leads = setup_->seat.role == Role::kInstructor && setup_->seat.kind == SeatKind::kMaster;
  const bool paused = s.session == wire::SessionState::kPaused, stopped = s.session == wire::SessionState::kStopped;
  std::string ends = words != nullptr && words->stop ? sanitize(words->stop->ends) : "";
  if (ends.empty()) ends = "an instructor or operator";
  if (stopped && !leads) return "r: you may not end this stop; it can be ended by: " + ends;
  if (paused && !leads && !setup_->may_end_pauses) return "r: you may not end this pause; it can be ended by: " + ends;
  if (paused && !leads && words != nullptr && words->stop && words->stop->number == s.stops && !words->stop->yours)
    return "r: this pause is not yours; it can be ended by: " + ends;
  if (paused || stopped) return {};
  if (s.session == wire::SessionState::kWaiting && leads)
    return {};  // after a restart, the session resumes without the missing participants
  if (s.session == wire::SessionState::kHeld)
    return "r: your hand is not stopped" +
           (words != nullptr && !words->held.empty() ? "; the tool is braked because: " + sanitize(words->held) : "");
  return "r: nothing is stopped, there is nothing to resume";
}

std::string KeyboardControls::change_authority(const std::string& key, const ClientStatus& status) {
  const bool less = key == "-" || key == "a" || (!keyboard_ && key == "left"),
             more = key == "+" || key == "=" || key == "d" || (!keyboard_ && key == "right");
  if (!less && !more && key != "0" && key != "1")
    return key.size() > 1 || key.front() > ' ' ? key + ": no such key. " + help() : "";
  if (!may_change_authority()) {
    const bool instructor = setup_->seat.role == Role::kInstructor && setup_->seat.kind == SeatKind::kMaster;
    return key + (instructor ? ": no other seat can have authority here" : ": only an instructor moves authority");
  }
  const double now = steps_.base(status);
  const std::string why = set_authority(key == "0"   ? 0
                                        : key == "1" ? 1
                                        : less       ? now - kAlphaStep
                                                     : now + kAlphaStep,
                                        status);
  return why.empty() ? "" : key + ": " + why;
}

std::string KeyboardControls::set_authority(double own, const ClientStatus& status) {
  // Rounds to the grid of 0.05, because repeated addition would not return to exactly 1.
  own = std::round(std::clamp(own, 0.0, 1.0) / kAlphaStep) * kAlphaStep;
  const bool alone = std::ranges::none_of(others_, [](double share) { return share > 0; });
  const bool stays = alone && own < 1;
  if (alone) own = 1;
  const bool same = steps_.counts(status) && own == steps_.base(status);
  if (!same) steps_.ask(own, status);
  control::MasterArray alpha{};
  for (std::size_t i = 0; i < setup_->masters.size(); ++i)
    alpha[i] = i == setup_->own_master ? own : (1 - own) * others_[i];
  commands_->change_authority(alpha);
  if (stays) return "no other seat may have authority: it stays with you";
  return !same      ? ""
         : own >= 1 ? "you have all authority already"
         : own <= 0 ? "you gave all authority away already"
                    : "";
}

std::string KeyboardControls::move_hand(int axis, double distance, const ClientStatus& status) {
  hal::Vec3 target = keyboard_->get();
  const double before = target[axis];
  target[axis] = std::clamp(target[axis] + distance, home_[axis] - kHandReach, home_[axis] + kHandReach);
  keyboard_->set(target);
  if (target[axis] == before)
    return format("the keyboard's hand reaches %.0f mm from its start, no farther", 1e3 * kHandReach);
  const bool follows = status.session != wire::SessionState::kRunning || status.alpha >= 0.5;
  const bool reported = std::exchange(other_leader_reported_, !follows);
  return follows || reported ? "" : "another hand leads: your keys pull at the tool, and it hardly follows you";
}

}  // namespace tandem::client
