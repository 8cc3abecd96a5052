#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "client/app/authority_steps.h"
#include "client/app/client_status.h"
#include "client/app/user_commands.h"
#include "hal/sim/hand.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Converts keys into requests: stop and resume, authority (INSTRUCTOR), reset of a latched gate, motion of a simulated
/// device by arrow keys, leave. For a key without effect, the reason is returned.
class KeyboardControls {
 public:
  /// @param keyboard  target of a simulated device that keys move; null for all other devices
  KeyboardControls(UserCommands& commands, const SeatSetup& setup, std::shared_ptr<hal::sim::KeyboardTarget> keyboard);

  /// Returns the effect of all keys in one line.
  [[nodiscard]] std::string help() const;
  struct KeyResult {
    bool leaves = false;  ///< the user wants to leave
    std::string why;      ///< why the key had no effect, with a remedy; empty: it had one
  };
  /// Returns the position set by keys relative to its start [m], 3x1; nullopt if keys do not move this device.
  [[nodiscard]] std::optional<std::array<double, 3>> keys() const;
  /// Handles one key.
  /// @param status  status of the seat
  /// @param words   newest status over the control connection; null: none
  KeyResult on_key(const std::string& key, const ClientStatus& status, const rpc::Status* words = nullptr);

 private:
  [[nodiscard]] bool may_change_authority() const noexcept {
    return setup_->moves_authority() && setup_->masters.size() > 1;
  }
  [[nodiscard]] std::string resume(const ClientStatus& status, const rpc::Status* words);
  [[nodiscard]] std::string stop_all(const ClientStatus& status);
  [[nodiscard]] std::string reset(const ClientStatus& status);
  [[nodiscard]] std::string change_authority(const std::string& key, const ClientStatus& status);
  [[nodiscard]] std::string set_authority(double own, const ClientStatus& status);
  [[nodiscard]] std::string move_hand(int axis, double distance, const ClientStatus& status);

  UserCommands* commands_;
  const SeatSetup* setup_;
  std::shared_ptr<hal::sim::KeyboardTarget> keyboard_;
  hal::Vec3 home_ = hal::Vec3::Zero();
  AuthoritySteps steps_;
  bool other_leader_reported_ = false;  ///< since the last motion by keys
  control::MasterArray others_{};  ///< distribution of the remaining authority over the other masters, sum 1, own 0
};

}  // namespace tandem::client
