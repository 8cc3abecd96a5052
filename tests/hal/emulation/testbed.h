#pragma once

#include <string>
#include <vector>

#include "hal/wire/wire_model.h"
#include "tests/hal/emulation/hidraw.h"
#include "tests/hal/emulation/usbfs.h"

namespace tandem::test {

/// A machine with nothing plugged in, until a test plugs something in: sysfs, udev's data, uevents and names of nodes
/// are umockdev's, what is behind a node is a UsbfsNode or HidrawNode. One at a time; needs umockdev's preload library
/// (main.cpp sees to it). The library is looked up at run time, so that nothing here needs it to be built.
class Testbed {
 public:
  Testbed();
  ~Testbed();
  Testbed(const Testbed&) = delete;

  /// Whether umockdev is installed; if not, why not.
  static bool available(std::string* why = nullptr);

  /// Plugs in and tells udev's listeners. The address counts up with every call, as the kernel's does.
  /// @param port  "1-2"
  void plug(UsbfsNode& node, const hal::wire::UsbWireModel& model, const std::string& port);
  void plug(HidrawNode& node, const hal::wire::HidWireModel& model, const std::string& port);
  /// The node's own unplugging is the caller's, before: first the kernel ends transfers, then it tells.
  void remove(const std::string& port);

  /// Rights of a node, e.g. 0: nobody may open it.
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

/// While it lives, this thread may not open what its rights forbid, even as root.
class WithoutOverride {
 public:
  WithoutOverride();
  ~WithoutOverride();
  WithoutOverride(const WithoutOverride&) = delete;

 private:
  unsigned before_[2] = {0, 0};
};

}  // namespace tandem::test
