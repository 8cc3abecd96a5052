#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/driver.h"
#include "hal/io/deadman.h"
#include "hal/io/device_choice.h"

namespace tandem::hal {

/// One thing a person wants to know of a device, such as {"firmware", "lost without power; ..."}.
struct DeviceFact {
  std::string about, words;
};

/// A device that is attached, seen without opening it.
struct FoundDevice {
  std::string words;    ///< what a person writes after --device to mean this one
  std::string about;    ///< as it calls itself, and where it is
  std::string trouble;  ///< why it could not be opened now, with the remedy; empty: nothing known
  std::string node;     ///< its file; empty: none
};

/// The file that the directions of a device's motors come from, and the device it was used with.
struct SignFile {
  std::string device;               ///< "serial:..." or, if it has none of its own, "port:..."; no spaces
  std::string name, sha256;         ///< as the person named it; of its bytes, lower-case hexadecimal
  std::vector<std::string> motors;  ///< as the file calls them, in the order of the joints
};

/// A driver for one device, opened and claimed, not brought up.
struct OpenedDriver {
  std::shared_ptr<void> bus;  ///< what the driver works with: pipe, clock; must outlive it
  std::unique_ptr<Driver> driver;
  std::optional<LastWords> last_words;  ///< for a Deadman; empty: nobody can speak for this device
  std::optional<SignFile> signs = {};   ///< of devices whose caps say signs_from_file, if current may flow at all
  std::string note = {};                ///< for the person: what this device will not do, and why
};

/// One kind of hardware: how it is found, how a driver for it is made. Never opens "the default" one: of several, a
/// person names theirs.
class Backend {
 public:
  virtual ~Backend() = default;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Lines for --help: the words after --device, and what they do.
  [[nodiscard]] virtual std::string_view help() const noexcept = 0;
  /// What speaks to such devices, with its version as it says itself: "libusb 1.0.26".
  [[nodiscard]] virtual std::string library() const = 0;
  /// What is so for every device of this kind, before one is opened: firmware, rate, calibration, homing, gravity.
  [[nodiscard]] virtual std::vector<DeviceFact> facts() const = 0;
  /// Error: why nothing can be listed at all, for example a missing library.
  [[nodiscard]] virtual Result<std::vector<FoundDevice>> list() = 0;
  /// Lines for the system that let whoever sits at the machine use such devices.
  [[nodiscard]] virtual std::vector<std::string> udev_rules() const { return {}; }
  /// Everything that is wrong with the words and with the files they name, whatever is attached; touches no device.
  /// Error kUnsupported: a line each.
  [[nodiscard]] virtual Result<> check(const DeviceChoice& choice) const = 0;
  /// Error: cause and remedy; kUnsupported: as of `check`.
  [[nodiscard]] virtual Result<OpenedDriver> open(const DeviceChoice& choice) = 0;
};

/// All that this build has; simulated devices are not among them.
[[nodiscard]] std::span<Backend* const> backends();
/// Error: names the nearest and all.
[[nodiscard]] Result<Backend*> find_backend(std::string_view name);

}  // namespace tandem::hal
