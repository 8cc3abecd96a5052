#include "hal/io/udev_rule.h"

#include "common/base/format.h"

namespace tandem::hal {

std::string udev_rule(Bus bus, UsbIds ids) {
  constexpr const char* kRights = "MODE=\"0660\", TAG+=\"uaccess\"";
  if (bus == Bus::kUsb) {
    return format("SUBSYSTEM==\"usb\", ATTR{idVendor}==\"%04x\", ATTR{idProduct}==\"%04x\", ", ids.vendor,
                  ids.product) +
           kRights;
  }
  // The kernel's name of a HID device, "0003:1234:0006.0001", exists on every bus; USB attributes do not.
  return format("SUBSYSTEM==\"hidraw\", KERNELS==\"*:%04X:%04X.*\", ", ids.vendor, ids.product) + kRights;
}

std::string udev_vendor_rule(std::uint16_t vendor) {
  return format("SUBSYSTEM==\"hidraw\", KERNELS==\"*:%04X:*\", MODE=\"0660\", TAG+=\"uaccess\"", vendor);
}

std::string udev_no_rule(UsbIds ids) {
  return format("SUBSYSTEM==\"hidraw\", KERNELS==\"*:%04X:%04X.*\", MODE=\"0600\", TAG-=\"uaccess\"", ids.vendor,
                ids.product);
}

std::string permission_advice(const AttachedDevice& device) {
  return "permission denied on " + device.node + " (" + describe(device) + "). Put this udev rule into " +
         kUdevRulesFile + ":\n  " + udev_rule(device.bus, device.ids) +
         "\nthen type 'sudo udevadm control --reload' and plug the device in again; 'tandem-client doctor "
         "--install-udev' "
         "does it for you.";
}

}  // namespace tandem::hal
