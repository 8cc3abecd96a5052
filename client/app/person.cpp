#include "client/app/person.h"

#include <algorithm>
#include <cmath>

namespace tandem::client {

namespace {
constexpr double kAlphaStep = 0.05;
constexpr double kHandStep = 0.005;  // [m] per key
constexpr double kHandReach = 0.06;  // [m] about the start, per axis
}  // namespace

Person::Person(SeatPump& pump, const SeatSetup& setup, std::shared_ptr<hal::sim::KeyboardTarget> keyboard)
    : pump_(&pump), setup_(&setup), keyboard_(std::move(keyboard)) {
  if (keyboard_) home_ = keyboard_->get();
  // What he does not keep goes in equal shares to all others who may have authority.
  double drivers = 0;
  for (std::size_t i = 0; i < setup.masters.size(); ++i) {
    const bool other = i != setup.own_master && (setup.drivers >> i & 1) != 0;
    others_[i] = other ? 1 : 0;
    drivers += others_[i];
  }
  for (double& share : others_) share /= std::max(1.0, drivers);
}

std::string Person::help() const {
  std::string text = "keys:";
  if (may_move_alpha())
    text += keyboard_ ? " a/d less/more authority for you, 0/1 none/all;"
                      : " left/right less/more authority for you, 0/1 none/all;";
  if (keyboard_) text += " arrows move right/left and away/towards you, PgUp/PgDn up/down;";
  return text + " s stops your hand, S everybody's" + (setup_->seat.role == Role::kInstructor ? "" : " (pause)") +
         ", r resumes; b button that clears DAMPED; q leaves";
}

bool Person::press(const std::string& key) {
  if (key == "q" || key == "Q" || key == "\x04") return true;
  if (key == "b") pump_->press_reset();
  if (key == "s" || key == " ") pump_->stop();
  if (key == "S") pump_->stop_all();
  if (key == "r") pump_->resume();
  if (keyboard_) {
    if (key == "right") move_hand(0, kHandStep);
    if (key == "left") move_hand(0, -kHandStep);
    if (key == "up") move_hand(1, kHandStep);
    if (key == "down") move_hand(1, -kHandStep);
    if (key == "pageup") move_hand(2, kHandStep);
    if (key == "pagedown") move_hand(2, -kHandStep);
  }
  if (!may_move_alpha()) return false;
  // Steps add to what was asked: authority itself moves there slowly.
  const double now = asked_ >= 0 ? asked_ : pump_->status().alpha;
  if (key == "0") set_alpha(0);
  if (key == "1") set_alpha(1);
  if (key == "-" || key == "a" || (!keyboard_ && key == "left")) set_alpha(now - kAlphaStep);
  if (key == "+" || key == "=" || key == "d" || (!keyboard_ && key == "right")) set_alpha(now + kAlphaStep);
  return false;
}

void Person::set_alpha(double own) {
  // Steps stay on the grid of 0.05: repeated addition would not come back to 1.
  own = std::round(std::clamp(own, 0.0, 1.0) / kAlphaStep) * kAlphaStep;
  const bool anybody = std::ranges::any_of(others_, [](double share) { return share > 0; });
  if (!anybody) own = 1;
  asked_ = own;
  control::Weights alpha{};
  for (std::size_t i = 0; i < setup_->masters.size(); ++i)
    alpha[i] = i == setup_->own_master ? own : (1 - own) * others_[i];
  pump_->request_authority(alpha);
}

void Person::move_hand(int axis, double distance) {
  hal::Vec3 target = keyboard_->get();
  target[axis] = std::clamp(target[axis] + distance, home_[axis] - kHandReach, home_[axis] + kHandReach);
  keyboard_->set(target);
}

}  // namespace tandem::client
