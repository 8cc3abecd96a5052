#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/app/servo_client_switch.h"
#include "common/io/terminal.h"
#include "hal/backends/backend.h"
#include "hal/core/device.h"
#include "hal/io/watchdog_process.h"

namespace tandem::client {

/// A hardware device before and during its seat: opened by its device specification, brought up with progress messages
/// and homed with the user's help. It exchanges zero force until a ServoClient is attached.
class HardwareDevice {
 public:
  /// Period of the exchanges with the device, independent of the scene's rate.
  static constexpr Duration kPeriod = std::chrono::milliseconds(1);

  /// True if the device specification of --device names hardware, not a simulated device.
  [[nodiscard]] static bool is_hardware_spec(std::string_view spec);

  /// Returns all errors of the device specification and of the files it names, one line each for the user. Does not
  /// depend on attached devices.
  [[nodiscard]] static std::vector<std::string> spec_errors(std::string_view spec);

  struct Failure {
    bool interrupted = false;
    bool invalid_spec = false;  ///< the specification is invalid, independent of attached devices
    std::string reason;         ///< cause and remedy, or the name of the signal
  };
  /// Handling of motor directions that come from a device file.
  struct Motors {
    std::string state = {};        ///< state directory of the motor registry, as given by --state
    bool being_confirmed = false;  ///< opened for the motor check: forces up to kConfirmingShare of the peak
  };
  /// Opens, brings up and homes the device. A device with unconfirmed motors is opened without force; `line` then shows
  /// a warning, and `no_force_reason` returns it.
  /// @param signals  signalfd (common/io/signals.h); a signal ends the bring-up and the homing
  [[nodiscard]] static std::expected<std::unique_ptr<HardwareDevice>, Failure> open(std::string_view spec, int signals,
                                                                                    io::StatusLine& line,
                                                                                    const Motors& motors);
  ~HardwareDevice();

  /// Returns the capabilities that a seat sees, after the rate control adapter if there is one.
  [[nodiscard]] hal::DeviceCaps caps() const;
  [[nodiscard]] hal::Device& device() noexcept { return *device_; }
  [[nodiscard]] const std::string& note() const noexcept { return note_; }
  /// Returns why the device gives no force, with the command that changes that; empty if it gives force.
  [[nodiscard]] const std::string& no_force_reason() const noexcept { return no_force_; }
  /// Source of the motor directions; empty: not from a file, or the motors get no current.
  [[nodiscard]] const std::optional<hal::SignFile>& signs() const noexcept { return signs_; }
  /// Name and version of the library that communicates with the device.
  [[nodiscard]] const std::string& library() const noexcept { return library_; }

  /// True if the watchdog process, which sends zero force after a crash of this program, was started and has ended.
  [[nodiscard]] bool watchdog_lost();

  /// Calls `client` with the device's own states from now on.
  void observe(hal::ServoClient& client) { client_.connect(client); }
  /// Calls `client` with the states that a seat sees, after the rate control adapter if there is one.
  /// @param client  must outlive `device().close()`  @pre `observe` was not called
  void attach(hal::ServoClient& client) { client_.connect_seat(client, device_->caps()); }

 private:
  HardwareDevice() = default;
  [[nodiscard]] std::expected<void, Failure> wait_until_homed(int signals, io::StatusLine& line);

  std::shared_ptr<void> bus_;
  std::unique_ptr<hal::WatchdogProcess> watchdog_;  ///< must outlive device_: ends cleanly after the device is closed
  ServoClientSwitch client_;
  std::unique_ptr<hal::Device> device_;
  std::optional<hal::SignFile> signs_;
  std::string note_, library_, no_force_;
};

}  // namespace tandem::client
