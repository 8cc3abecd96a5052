#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "client/app/authority_steps.h"
#include "client/app/seat_pump.h"
#include "hal/sim/hand.h"
#include "proto/control_messages.h"

namespace tandem::client {

/// Turns keys into wishes: stop and resume, authority (INSTRUCTOR), the button that clears a latched gate, a hand moved by arrow keys,
/// leaving. A key that does nothing says why.
class Person {
 public:
  /// @param keyboard  of a hand that is moved by keys; null for all others
  Person(SeatPump& pump, const SeatSetup& setup, std::shared_ptr<hal::sim::KeyboardTarget> keyboard);

  /// What the keys do, one line.
  [[nodiscard]] std::string help() const;
  struct Pressed {
    bool leaves = false;  ///< the person wants to leave
    std::string why;      ///< why the key did nothing, and what to do; empty: it did something
  };
  /// Where keys hold the hand, from its start [m]; nothing: no keys move it.
  [[nodiscard]] std::optional<std::array<double, 3>> keys() const;
  /// @param status  of the seat  @param words  what the server said last over the control connection; null: nothing
  Pressed press(const std::string& key, const ClientStatus& status, const control::Status* words = nullptr);

 private:
  [[nodiscard]] bool may_move_alpha() const noexcept { return setup_->moves_authority() && setup_->masters.size() > 1; }
  [[nodiscard]] std::string resume(const ClientStatus& status, const control::Status* words);
  [[nodiscard]] std::string stop_all(const ClientStatus& status);
  [[nodiscard]] std::string reset(const ClientStatus& status);
  [[nodiscard]] std::string change_alpha(const std::string& key, const ClientStatus& status);
  [[nodiscard]] std::string set_alpha(double own, const ClientStatus& status);
  [[nodiscard]] std::string move_hand(int axis, double distance, const ClientStatus& status);

  SeatPump* pump_;
  const SeatSetup* setup_;
  std::shared_ptr<hal::sim::KeyboardTarget> keyboard_;
  hal::Vec3 home_ = hal::Vec3::Zero();
  AuthoritySteps steps_;
  bool told_that_another_leads_ = false;  ///< since the hand was moved last
  control::Weights others_{};  ///< how the rest is shared, sum 1, own 0
};

}  // namespace tandem::client
