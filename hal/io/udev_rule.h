#pragma once

#include <cstdint>
#include <string>

#include "hal/io/enumeration.h"

/// udev rules that give users access to devices, and the advice that explains them.
namespace tandem::hal {

/// File of Tandem's rules. It precedes 73-seat-late.rules, which acts on the tag.
inline constexpr const char* kUdevRulesFile = "/etc/udev/rules.d/70-tandem.rules";

/// Returns one line without line feed: users logged in at this machine may use devices with these ids on this bus.
[[nodiscard]] std::string udev_rule(Bus bus, UsbIds ids);

/// Returns the same for every HID device of a vendor, so that later products are included.
[[nodiscard]] std::string udev_vendor_rule(std::uint16_t vendor);
/// Returns the line that revokes an earlier rule for these ids: mice and keyboards of such a vendor.
[[nodiscard]] std::string udev_no_rule(UsbIds ids);

/// Returns advice for "permission denied": names the node, the rule, its file and the command that loads it.
[[nodiscard]] std::string permission_advice(const AttachedDevice& device);

}  // namespace tandem::hal
