#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/backends/device_spec_parser.h"
#include "hal/core/driver.h"
#include "hal/io/watchdog_process.h"

namespace tandem::hal {

/// One fact about a device for the user, such as {"firmware", "lost without power; ..."}.
struct DeviceFact {
  std::string topic, text;
};

/// An attached device, found without opening it.
struct FoundDevice {
  std::string spec;         ///< device specification for `--device` that selects this device
  std::string description;  ///< the name the device reports and its port
  std::string problem;      ///< why it cannot be opened now, with the remedy; empty: no known problem
  std::string node;         ///< device file; empty: none
};

/// Sign file: the source of a device's motor directions, and the device it was used with.
struct SignFile {
  std::string device;        ///< "serial:...", or "port:..." if the device has no serial number of its own; no spaces
  std::string name, sha256;  ///< name as the user gave it; SHA-256 of its bytes, lower-case hexadecimal
  std::vector<std::string> motors;  ///< names of the motors in the file, in the order of the joints
};

/// A driver for one device, opened and claimed but not brought up.
struct OpenedDriver {
  std::shared_ptr<void> bus;  ///< resources of the driver: pipe, clock; must outlive it
  std::unique_ptr<Driver> driver;
  /// Frame for a WatchdogProcess; empty: the watchdog cannot act for this device.
  std::optional<ShutdownFrame> shutdown_frame;
  /// Sign file of devices whose caps have signs_from_file, if motor current is enabled at all.
  std::optional<SignFile> signs = {};
  std::string note = {};  ///< text for the user: restrictions of this device and their reason
};

/// Backend of one kind of hardware: finds devices and creates drivers for them.
/// A backend never opens a default device: of several devices the user names one.
class Backend {
 public:
  virtual ~Backend() = default;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Returns the lines for --help: the device specifications and their effect.
  [[nodiscard]] virtual std::string_view help() const noexcept = 0;
  /// Returns the library used for such devices, with the version it reports: "libusb 1.0.26".
  [[nodiscard]] virtual std::string library() const = 0;
  /// Returns the facts common to all devices of this kind, known before opening: firmware, rate, calibration, homing,
  /// gravity.
  [[nodiscard]] virtual std::vector<DeviceFact> facts() const = 0;
  /// Returns the devices found. Error: why none can be listed, for example a missing library.
  [[nodiscard]] virtual Result<std::vector<FoundDevice>> list() = 0;
  /// Returns udev rules that give users logged in at this machine access to such devices.
  [[nodiscard]] virtual std::vector<std::string> udev_rules() const { return {}; }
  /// Checks the specification and the files it names, independent of attached devices; touches no device.
  /// Error kUnsupported: one line per error.
  [[nodiscard]] virtual Result<> check(const DeviceSpec& choice) const = 0;
  /// Opens and claims the chosen device. Error: cause and remedy; kUnsupported: as of `check`.
  [[nodiscard]] virtual Result<OpenedDriver> open(const DeviceSpec& choice) = 0;
};

/// Returns all backends of this build, without simulated devices.
[[nodiscard]] std::span<Backend* const> backends();
/// Returns the backend of that name. Error: names the nearest name and all names.
[[nodiscard]] Result<Backend*> find_backend(std::string_view name);

}  // namespace tandem::hal
