#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "client/diagnostics/motor_registry.h"
#include "hal/backends/backend.h"

namespace tandem::client {

/// The motor registry of the workstation on disk: the file `confirmed_motors` in its state directory. Writes go to a
/// temporary file that is synced and renamed, so a full disk or a kill leaves the old or the new registry.
class MotorRegistryFile {
 public:
  static constexpr const char* kFile = "confirmed_motors";

  /// @param option  state directory as given by --state; empty: $TANDEM_CLIENT_STATE, else ~/.config/tandem
  explicit MotorRegistryFile(std::string option) : option_(std::move(option)) {}

  /// Returns the record of this device with this file; nullopt if there is none. Error: why the file cannot be read.
  [[nodiscard]] std::expected<std::optional<MotorRecord>, std::string> find(const hal::SignFile& signs) const;
  /// Returns why a record could not be stored; empty if it could. Call before any force, so that a result is not lost.
  [[nodiscard]] std::string storage_error() const;
  /// Stores a record. @return the error; empty if the record is on disk
  [[nodiscard]] std::string store(const hal::SignFile& signs, bool confirmed) const;
  /// Returns the shell command that confirms the motors of this device. @param device  device specification
  [[nodiscard]] std::string command(std::string_view device) const;

 private:
  std::string option_;
};

}  // namespace tandem::client
