#pragma once

#include <cstdint>
#include <string>

#include "hal/io/attached.h"

/// Why a person may not open a device, and the line of text that lets him.
namespace tandem::hal {

/// Where our rules go. Before 73-seat-late.rules, which acts on the tag.
inline constexpr const char* kUdevRulesFile = "/etc/udev/rules.d/70-tandem.rules";

/// One line without its end: whoever sits at this machine may use devices with these ids on this bus.
[[nodiscard]] std::string udev_rule(Bus bus, UsbIds ids);

/// The same for every HID device of a vendor, also for products nobody knew when this was written.
[[nodiscard]] std::string udev_vendor_rule(std::uint16_t vendor);
/// Takes back what a line before gave: mice and keyboards of such a vendor.
[[nodiscard]] std::string udev_no_rule(UsbIds ids);

/// What to do about "permission denied": names the node, the rule, its file and the command that loads it.
[[nodiscard]] std::string permission_advice(const Attached& device);

}  // namespace tandem::hal
