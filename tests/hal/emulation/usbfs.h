#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "hal/wire/wire_model.h"
#include "tests/hal/emulation/model_node.h"

namespace tandem::test {

/// usbfs in front of a wire model: what libusb's Linux backend asks of /dev/bus/usb/BBB/DDD. After an
/// unplugging, pending transfers end with -ESHUTDOWN, then everything is -ENODEV, as in the kernel.
class UsbfsNode final : public ModelNode<hal::wire::UsbWireModel> {
 public:
  explicit UsbfsNode(hal::wire::UsbWireModel& model, std::string kernel_driver = {});
  ~UsbfsNode() override;

  long on_ioctl(int fd, unsigned long request, void* argument) override;
  void service() override;

  [[nodiscard]] std::string kernel_driver() const;  ///< bound to the interface now

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
