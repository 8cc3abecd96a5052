#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/device.h"

/// What is plugged into this machine, without opening any of it: listing needs no permission.
namespace tandem::hal {

enum class Bus : std::uint8_t { kUsb, kHidraw };

struct UsbIds {
  std::uint16_t vendor = 0, product = 0;
  friend bool operator==(const UsbIds&, const UsbIds&) = default;
};

/// What a HID collection says it is for (USB HID Usage Tables).
struct HidUsage {
  std::uint16_t page = 0, usage = 0;
  friend bool operator==(const HidUsage&, const HidUsage&) = default;
};

struct Attached {
  Bus bus = Bus::kUsb;
  UsbIds ids;
  std::string maker, name, serial;  ///< as the device says; empty where it says nothing
  std::string port;                 ///< "1-2.3": the socket, the same after replugging; empty when it is not on USB
  std::string node;                 ///< "/dev/bus/usb/001/004", "/dev/hidraw0"
  std::string instance;             ///< another one after every plugging in
  unsigned bus_number = 0, address = 0;  ///< USB only
  int interface_number = -1;             ///< HID on USB only
  std::vector<HidUsage> usages;          ///< HID only: its top-level collections
};

/// USB devices (libudev) and hidraw devices (hidapi), in the order of their nodes. Thread-safe.
[[nodiscard]] std::vector<Attached> list_usb();
[[nodiscard]] std::vector<Attached> list_hidraw();

/// Which device a person means. What is not given does not narrow.
struct Wanted {
  std::string what;         ///< for messages: "Novint Falcon"
  std::vector<UsbIds> ids;  ///< any of these
  std::optional<HidUsage> usage;
  std::optional<std::string> serial, port;
};

/// The one device that is meant. Error kNotFound: says what was looked for and what is attached; kBadState: several
/// fit, with the words that tell them apart. There is no default among several.
[[nodiscard]] Result<Attached> choose(std::span<const Attached> attached, const Wanted& wanted);

/// "0403:cb48 FALCON HAPTIC, serial 7, at port 1-2".
[[nodiscard]] std::string describe(const Attached& device);

}  // namespace tandem::hal
