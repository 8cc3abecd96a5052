#pragma once

#include <string>
#include <vector>

#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/hidraw.h"
#include "tests/hal/emulation/usbfs.h"

namespace tandem::test {

/// A machine without devices, until a test plugs one in. sysfs, udev's data, uevents and node names are umockdev's; a
/// UsbfsNode or HidrawNode is behind a node.
/// One at a time. It needs umockdev's preload library, which main.cpp loads. The library is looked up at run time, so
/// the build does not need it.
class Testbed {
 public:
  Testbed();
  ~Testbed();
  Testbed(const Testbed&) = delete;

  /// Returns whether umockdev is installed; `why`: the reason if not.
  static bool available(std::string* why = nullptr);

  /// Plugs in a device and notifies udev's listeners. The address increases with every call, as the kernel's does.
  /// @param port  "1-2"
  void plug(UsbfsNode& node, const hal::emulation::EmulatedUsbDevice& model, const std::string& port);
  void plug(HidrawNode& node, const hal::emulation::EmulatedHidDevice& model, const std::string& port);
  /// Removes the device from sysfs and notifies udev's listeners.
  /// The caller unplugs the node first: the kernel ends transfers before it notifies.
  void remove(const std::string& port);

  /// Sets the permissions of a node, e.g. 0: no user may open it.
  void set_mode(const std::string& node, unsigned mode) const;

 private:
  struct Plugged {
    std::string port;
    std::vector<std::string> sysfs;  ///< children first
  };
  void add(const std::string& text);
  void lead_node(const std::string& name, const PollGate& gate) const;
  void tell(const std::string& sysfs, const char* action);

  void* bed_ = nullptr;
  std::string root_;
  std::vector<Plugged> plugged_;
  unsigned next_address_ = 4;
};

/// While this object exists, file permissions apply to this thread even as root.
class WithoutOverride {
 public:
  WithoutOverride();
  ~WithoutOverride();
  WithoutOverride(const WithoutOverride&) = delete;

 private:
  unsigned before_[2] = {0, 0};
};

}  // namespace tandem::test
