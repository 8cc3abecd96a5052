#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/model_node.h"

namespace tandem::test {

/// usbfs in front of a device model: the calls of libusb's Linux backend on /dev/bus/usb/BBB/DDD.
/// After unplugging, pending transfers end with -ESHUTDOWN, then every call returns -ENODEV, as in the kernel.
class UsbfsNode final : public ModelNode<hal::emulation::EmulatedUsbDevice> {
 public:
  explicit UsbfsNode(hal::emulation::EmulatedUsbDevice& model, std::string kernel_driver = {});
  ~UsbfsNode() override;

  long on_ioctl(int fd, unsigned long request, void* argument) override;
  void service() override;

  [[nodiscard]] std::string kernel_driver() const;  ///< driver bound to the interface now

 private:
  struct Urb;
  long submit(void* argument);
  long reap(void* argument);
  long discard(void* argument);
  long claim(int fd);
  bool carry_out(Urb& urb);
  void finish(Urb urb);
  void serve();
  void end_transfers() override;
  long driver_request(void* argument);

  std::string driver_, detached_;
  std::optional<int> claimed_by_;
  std::deque<Urb> pending_, done_;
};

}  // namespace tandem::test
