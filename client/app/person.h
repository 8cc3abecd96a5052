#pragma once

#include <memory>
#include <string>

#include "client/app/seat_pump.h"
#include "hal/sim/hand.h"

namespace tandem::client {

/// Turns keys into wishes: stop and resume, authority (INSTRUCTOR), the button that clears a latched gate, a hand moved by arrow keys,
/// leaving.
class Person {
 public:
  /// @param keyboard  of a hand that is moved by keys; null for all others
  Person(SeatPump& pump, const SeatSetup& setup, std::shared_ptr<hal::sim::KeyboardTarget> keyboard);

  /// What the keys do, one line.
  [[nodiscard]] std::string help() const;
  /// @return true if the person wants to leave
  bool press(const std::string& key);

 private:
  [[nodiscard]] bool may_move_alpha() const noexcept { return setup_->moves_authority() && setup_->masters.size() > 1; }
  void set_alpha(double own);
  void move_hand(int axis, double distance);

  SeatPump* pump_;
  const SeatSetup* setup_;
  std::shared_ptr<hal::sim::KeyboardTarget> keyboard_;
  hal::Vec3 home_ = hal::Vec3::Zero();
  double asked_ = -1;          ///< own weight asked for last; negative: none yet
  control::Weights others_{};  ///< how the rest is shared, sum 1, own 0
};

}  // namespace tandem::client
