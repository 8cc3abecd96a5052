#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "client/motor_book.h"
#include "hal/io/backend.h"

namespace tandem::client {

/// The workstation's book of confirmed motors: the file `confirmed_motors` of its state folder. It is written beside, synced and renamed:
/// a full disk or a kill leaves the old book or the new one.
class MotorState {
 public:
  static constexpr const char* kFile = "confirmed_motors";

  /// @param option  the folder as given by --state; empty: $TANDEM_CLIENT_STATE, else ~/.config/tandem
  explicit MotorState(std::string option) : option_(std::move(option)) {}

  /// What is known of this device with this file; nothing: never asked. Error: why the book cannot be read.
  [[nodiscard]] std::expected<std::optional<MotorRecord>, std::string> find(const hal::SignFile& signs) const;
  /// Why nothing could be kept; empty: it could. To be asked before any force.
  [[nodiscard]] std::string unfit_to_keep() const;
  /// @return what is wrong, empty if it is on disk
  [[nodiscard]] std::string keep(const hal::SignFile& signs, bool confirmed) const;
  /// What a person types to confirm the motors of the device they named so.
  [[nodiscard]] std::string command(std::string_view device) const;

 private:
  std::string option_;
};

}  // namespace tandem::client
