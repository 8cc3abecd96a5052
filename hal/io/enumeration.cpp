#include "hal/io/enumeration.h"

#include <hidapi/hidapi.h>
#include <libudev.h>

#include <algorithm>
#include <cstdlib>
#include <cwchar>
#include <memory>

#include "common/base/format.h"
#include "hal/io/hidapi_lock.h"

namespace tandem::hal {
namespace {

template <auto kRelease>
struct Releaser {
  template <class T>
  void operator()(T* p) const noexcept {
    kRelease(p);
  }
};
using Udev = std::unique_ptr<udev, Releaser<udev_unref>>;
using UdevDevice = std::unique_ptr<udev_device, Releaser<udev_device_unref>>;
using UdevEnumerate = std::unique_ptr<udev_enumerate, Releaser<udev_enumerate_unref>>;

std::string text(const char* s) { return s == nullptr ? "" : s; }

std::string attribute(udev_device* device, const char* name) {
  return text(udev_device_get_sysattr_value(device, name));
}

unsigned number(const std::string& digits, int base) {
  return static_cast<unsigned>(std::strtoul(digits.c_str(), nullptr, base));
}

/// Returns hidapi's wide text as ASCII, other characters as '?': it is used for messages and comparisons.
std::string narrow(const wchar_t* wide) {
  std::string out;
  for (; wide != nullptr && *wide != L'\0'; ++wide) out += *wide >= 32 && *wide < 127 ? static_cast<char>(*wide) : '?';
  return out;
}

/// Adds port and instance of a hidraw node, from its ancestors in udev.
void add_ancestors(udev* context, AttachedDevice& found) {
  const std::string name = found.node.substr(found.node.rfind('/') + 1);
  const UdevDevice node(udev_device_new_from_subsystem_sysname(context, "hidraw", name.c_str()));
  if (node == nullptr) return;
  // The parents are owned by `node`.
  if (udev_device* hid = udev_device_get_parent_with_subsystem_devtype(node.get(), "hid", nullptr)) {
    found.instance = text(udev_device_get_sysname(hid)) + "/" + name;
  }
  if (udev_device* usb = udev_device_get_parent_with_subsystem_devtype(node.get(), "usb", "usb_device")) {
    found.port = text(udev_device_get_sysname(usb));
    found.instance += "#" + attribute(usb, "devnum");
  }
}

bool fits(const AttachedDevice& device, const DeviceFilter& wanted) {
  if (!wanted.ids.empty() && std::ranges::find(wanted.ids, device.ids) == wanted.ids.end()) return false;
  if (wanted.usage && std::ranges::find(device.usages, *wanted.usage) == device.usages.end()) return false;
  if (wanted.serial && device.serial != *wanted.serial) return false;
  return !wanted.port || device.port == *wanted.port;
}

std::string said(const DeviceFilter& wanted) {
  std::string out = wanted.what;
  if (wanted.serial) out += " with serial " + *wanted.serial;
  if (wanted.port) out += " at port " + *wanted.port;
  return out;
}

std::string said(UsbIds ids) { return format("%04x:%04x", ids.vendor, ids.product); }

}  // namespace

std::vector<AttachedDevice> list_usb() {
  std::vector<AttachedDevice> list;
  const Udev context(udev_new());
  if (context == nullptr) return list;
  const UdevEnumerate all(udev_enumerate_new(context.get()));
  if (all == nullptr) return list;
  udev_enumerate_add_match_subsystem(all.get(), "usb");
  udev_enumerate_add_match_property(all.get(), "DEVTYPE", "usb_device");
  udev_enumerate_scan_devices(all.get());
  udev_list_entry* entry = nullptr;
  udev_list_entry_foreach(entry, udev_enumerate_get_list_entry(all.get())) {
    const UdevDevice device(udev_device_new_from_syspath(context.get(), udev_list_entry_get_name(entry)));
    if (device == nullptr) continue;  // just unplugged
    udev_device* d = device.get();
    AttachedDevice found;
    found.ids = {static_cast<std::uint16_t>(number(attribute(d, "idVendor"), 16)),
                 static_cast<std::uint16_t>(number(attribute(d, "idProduct"), 16))};
    found.maker = attribute(d, "manufacturer");
    found.name = attribute(d, "product");
    found.serial = attribute(d, "serial");
    found.port = text(udev_device_get_sysname(d));
    found.node = text(udev_device_get_devnode(d));
    found.bus_number = number(attribute(d, "busnum"), 10);
    found.address = number(attribute(d, "devnum"), 10);
    found.instance = found.port + "#" + std::to_string(found.address);
    list.push_back(std::move(found));
  }
  std::ranges::sort(list, {}, &AttachedDevice::node);
  return list;
}

std::vector<AttachedDevice> list_hidraw() {
  std::vector<AttachedDevice> list;
  const Udev context(udev_new());
  if (context == nullptr) return list;
  const HidapiLock lock;
  const std::unique_ptr<hid_device_info, Releaser<hid_free_enumeration>> all(hid_enumerate(0, 0));
  for (const hid_device_info* info = all.get(); info != nullptr; info = info->next) {
    const HidUsage usage{info->usage_page, info->usage};
    // hidapi lists one entry per top-level collection. Entries of one node are merged.
    if (auto same = std::ranges::find(list, std::string_view(info->path), &AttachedDevice::node); same != list.end()) {
      same->usages.push_back(usage);
      continue;
    }
    AttachedDevice found;
    found.bus = Bus::kHidraw;
    found.ids = {info->vendor_id, info->product_id};
    found.maker = narrow(info->manufacturer_string);
    found.name = narrow(info->product_string);
    found.serial = narrow(info->serial_number);
    found.node = info->path;
    found.interface_number = info->interface_number;
    found.usages = {usage};
    add_ancestors(context.get(), found);
    list.push_back(std::move(found));
  }
  std::ranges::sort(list, {}, &AttachedDevice::node);
  return list;
}

std::string describe(const AttachedDevice& device) {
  std::string out = said(device.ids);
  if (!device.name.empty()) out += " " + device.name;
  if (!device.serial.empty()) out += ", serial " + device.serial;
  return out + (device.port.empty() ? ", " + device.node : ", at port " + device.port);
}

Result<AttachedDevice> select_device(std::span<const AttachedDevice> attached, const DeviceFilter& wanted) {
  std::vector<const AttachedDevice*> fitting;
  for (const AttachedDevice& device : attached) {
    if (fits(device, wanted)) fitting.push_back(&device);
  }
  if (fitting.size() == 1) return *fitting.front();
  std::string message;
  if (fitting.empty()) {
    message = "no " + said(wanted) + " is attached";
    for (const UsbIds& ids : wanted.ids) message += (&ids == &wanted.ids.front() ? " (USB id " : ", ") + said(ids);
    message += wanted.ids.empty() ? "; " : "); ";
    message += attached.empty() ? "nothing is" : "there are ";
    for (const AttachedDevice& device : attached)
      message += (&device == &attached.front() ? "" : "; ") + describe(device);
    message += ". Check its cable and its power";
    return std::unexpected(DeviceError{Errc::kNotFound, std::move(message)});
  }
  message = std::to_string(fitting.size()) + " devices match " + said(wanted) + "; select one:";
  for (const AttachedDevice* device : fitting) {
    const bool by_port = !device->port.empty();
    message += std::string(device == fitting.front() ? " " : ", or ") +
               (by_port ? "port=" + device->port : "serial=" + device->serial) + " (" + describe(*device) + ")";
  }
  return std::unexpected(DeviceError{Errc::kBadState, std::move(message)});
}

}  // namespace tandem::hal
