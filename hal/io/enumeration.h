#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/core/device.h"

/// Devices plugged into this machine, listed without opening them: listing needs no permission.
namespace tandem::hal {

enum class Bus : std::uint8_t { kUsb, kHidraw };

struct UsbIds {
  std::uint16_t vendor = 0, product = 0;
  friend bool operator==(const UsbIds&, const UsbIds&) = default;
};

/// Usage of a HID collection, as it declares it (USB HID Usage Tables).
struct HidUsage {
  std::uint16_t page = 0, usage = 0;
  friend bool operator==(const HidUsage&, const HidUsage&) = default;
};

struct AttachedDevice {
  Bus bus = Bus::kUsb;
  UsbIds ids;
  std::string maker, name, serial;       ///< as the device reports; empty: not reported
  std::string port;                      ///< "1-2.3": the socket, constant over replugging; empty: not on USB
  std::string node;                      ///< "/dev/bus/usb/001/004", "/dev/hidraw0"
  std::string instance;                  ///< changes with every plugging in
  unsigned bus_number = 0, address = 0;  ///< USB only
  int interface_number = -1;             ///< HID on USB only
  std::vector<HidUsage> usages;          ///< HID only: its top-level collections
};

/// Return all USB devices (libudev) and all hidraw devices (hidapi), in the order of their nodes. Thread-safe.
[[nodiscard]] std::vector<AttachedDevice> list_usb();
[[nodiscard]] std::vector<AttachedDevice> list_hidraw();

/// Filter that selects one device. Empty members do not filter.
struct DeviceFilter {
  std::string what;         ///< for messages: "Novint Falcon"
  std::vector<UsbIds> ids;  ///< any of these matches
  std::optional<HidUsage> usage;
  std::optional<std::string> serial, port;
};

/// Returns the one device that matches. There is no default among several.
/// Error kNotFound: names the filter and the attached devices. Error kBadState: several match; names the options that
/// distinguish them.
[[nodiscard]] Result<AttachedDevice> select_device(std::span<const AttachedDevice> attached,
                                                   const DeviceFilter& wanted);

/// Returns a description: "0403:cb48 FALCON HAPTIC, serial 7, at port 1-2".
[[nodiscard]] std::string describe(const AttachedDevice& device);

}  // namespace tandem::hal
