#include "tests/hal/emulation/testbed.h"

#include <dlfcn.h>
#include <linux/capability.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <ranges>

#include "common/base/format.h"

namespace tandem::test {
namespace {

/// umockdev's C interface, as far as used here; its objects are GObjects.
struct Library {
  void* (*testbed_new)() = nullptr;
  char* (*get_root_dir)(void*) = nullptr;
  int (*add_from_string)(void*, const char*, void**) = nullptr;
  void (*uevent)(void*, const char*, const char*) = nullptr;
  void (*remove_device)(void*, const char*) = nullptr;
  void (*unref)(void*) = nullptr;
  void (*free)(void*) = nullptr;
  std::string trouble;

  Library() {
    void* handle = dlopen("libumockdev.so.0", RTLD_NOW | RTLD_GLOBAL);
    if (handle == nullptr) {
      trouble = "umockdev is not installed (package umockdev)";
      return;
    }
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, name));
      if (function == nullptr) trouble = std::string("umockdev has no ") + name;
    };
    find(testbed_new, "umockdev_testbed_new");
    find(get_root_dir, "umockdev_testbed_get_root_dir");
    find(add_from_string, "umockdev_testbed_add_from_string");
    find(uevent, "umockdev_testbed_uevent");
    find(remove_device, "umockdev_testbed_remove_device");
    find(unref, "g_object_unref");
    find(free, "g_free");
    if (dlopen("libumockdev-preload.so.0", RTLD_NOW | RTLD_NOLOAD) == nullptr)
      trouble = "umockdev's preload library is not loaded";
  }
};

const Library& library() {
  static const Library one;
  return one;
}

std::string hex(std::span<const std::byte> bytes) {
  std::string out;
  for (const std::byte b : bytes) out += format("%02X", static_cast<unsigned>(b));
  return out;
}

unsigned u16(std::span<const std::byte> bytes, std::size_t at) {
  return static_cast<unsigned>(bytes[at]) | static_cast<unsigned>(bytes[at + 1]) << 8;
}

constexpr const char* kController = "/devices/pci0000:00/usb1/";

std::string usb_device(const std::string& port, unsigned address, unsigned vendor, unsigned product,
                       std::string_view maker, std::string_view name, std::string_view serial,
                       const std::string& descriptors) {
  std::string text = "P: " + (kController + port) + "\n" + format("N: bus/usb/001/%03u\n", address);
  text += format(
      "E: DEVNAME=/dev/bus/usb/001/%03u\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=%03u\n"
      "E: MAJOR=189\nE: MINOR=%u\n",
      address, address, address - 1);
  text += format(
      "A: busnum=1\nA: devnum=%u\nA: bConfigurationValue=1\nA: speed=12\nA: dev=189:%u\nA: idVendor=%04x\nA: "
      "idProduct=%04x\n",
      address, address - 1, vendor, product);
  if (!maker.empty()) text += "A: manufacturer=" + std::string(maker) + "\n";
  if (!name.empty()) text += "A: product=" + std::string(name) + "\n";
  if (!serial.empty()) text += "A: serial=" + std::string(serial) + "\n";
  return text + "H: descriptors=" + descriptors + "\n\n";
}

}  // namespace

bool Testbed::available(std::string* why) {
  if (why != nullptr) *why = library().trouble;
  return library().trouble.empty();
}

Testbed::Testbed() : bed_(library().testbed_new()) {
  char* root = library().get_root_dir(bed_);
  root_ = root;
  library().free(root);
}

Testbed::~Testbed() { library().unref(bed_); }

void Testbed::add(const std::string& text) {
  if (library().add_from_string(bed_, text.c_str(), nullptr) != 0) return;
  std::fprintf(stderr, "umockdev refuses this device:\n%s", text.c_str());
  std::abort();
}

void Testbed::lead_node(const std::string& name, const PollGate& gate) const {
  const std::filesystem::path node = root_ + "/dev/" + name;
  std::filesystem::remove(node);
  std::filesystem::create_directories(node.parent_path());
  std::filesystem::create_symlink(gate.path(), node);
}

void Testbed::tell(const std::string& sysfs, const char* action) {
  library().uevent(bed_, ("/sys" + sysfs).c_str(), action);
}

void Testbed::plug(UsbfsNode& node, const hal::emulation::EmulatedUsbDevice& model, const std::string& port) {
  const unsigned address = next_address_++;
  const auto device = model.device_descriptor();
  const auto text_of = [&](std::size_t at) { return model.string(static_cast<std::uint8_t>(device[at])); };
  constexpr std::size_t kVendor = 8, kProduct = 10, kMakerText = 14, kNameText = 15, kSerialText = 16;
  add(usb_device(port, address, u16(device, kVendor), u16(device, kProduct), text_of(kMakerText), text_of(kNameText),
                 text_of(kSerialText), hex(device) + hex(model.config_descriptor())));
  lead_node(format("bus/usb/001/%03u", address), node.gate());
  plugged_.push_back({port, {kController + port}});
  tell(kController + port, "add");
}

void Testbed::plug(HidrawNode& node, const hal::emulation::EmulatedHidDevice& model, const std::string& port) {
  const unsigned address = next_address_++;
  unsigned number = 0;  // the lowest free number, as in the kernel: names are reused
  while (std::filesystem::is_symlink(root_ + format("/dev/hidraw%u", number))) ++number;
  const std::string usb = kController + port, interface = usb + "/" + port + ":1.0",
                    hid = interface + format("/0003:%04X:%04X.%04X", model.vendor_id(), model.product_id(), address),
                    raw = hid + format("/hidraw/hidraw%u", number);
  std::string text =
      usb_device(port, address, model.vendor_id(), model.product_id(), model.manufacturer(), model.product(),
                 model.serial(), "12010002000000403412060000010102030109022200010100A032");
  text += "P: " + interface + "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\n\n";
  text += "P: " + hid + "\nE: SUBSYSTEM=hid\n" +
          format("E: HID_ID=0003:%08X:%08X\n", model.vendor_id(), model.product_id());
  text += "E: HID_NAME=" + std::string(model.manufacturer()) + " " + std::string(model.product()) +
          "\nE: HID_UNIQ=" + std::string(model.serial()) + "\nH: report_descriptor=" + hex(model.report_descriptor()) +
          "\n\n";
  text += "P: " + raw +
          format("\nE: DEVNAME=/dev/hidraw%u\nE: SUBSYSTEM=hidraw\nE: MAJOR=240\nE: MINOR=%u\n", number, number);
  text += "L: device=../../../" + hid.substr(hid.rfind('/') + 1) + "\n\n";
  add(text);
  lead_node(format("hidraw%u", number), node.gate());
  plugged_.push_back({port, {raw, hid, interface, usb}});
  for (const std::string& one : plugged_.back().sysfs | std::views::reverse) tell(one, "add");
}

void Testbed::remove(const std::string& port) {
  const auto found = std::ranges::find(plugged_, port, &Plugged::port);
  for (const std::string& one : found->sysfs) {
    tell(one, "remove");
    library().remove_device(bed_, ("/sys" + one).c_str());
    if (const auto raw = one.find("/hidraw/"); raw != std::string::npos) {
      std::filesystem::remove(root_ + "/dev" + one.substr(raw + std::string("/hidraw").size()));
    }
  }
  plugged_.erase(found);
}

void Testbed::set_mode(const std::string& node, unsigned mode) const { chmod((root_ + node).c_str(), mode); }

WithoutOverride::WithoutOverride() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[2] = {};
  syscall(SYS_capget, &header, data);
  for (int i = 0; i < 2; ++i) before_[i] = data[i].effective;
  data[0].effective &= ~((1u << CAP_DAC_OVERRIDE) | (1u << CAP_DAC_READ_SEARCH));
  syscall(SYS_capset, &header, data);
}

WithoutOverride::~WithoutOverride() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[2] = {};
  syscall(SYS_capget, &header, data);
  for (int i = 0; i < 2; ++i) data[i].effective = before_[i];
  syscall(SYS_capset, &header, data);
}

}  // namespace tandem::test
