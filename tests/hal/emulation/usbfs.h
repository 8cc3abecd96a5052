#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "hal/wire/wire_model.h"
#include "tests/hal/emulation/node.h"

namespace tandem::test {

/// usbfs in front of a wire model: what libusb's Linux backend asks of /dev/bus/usb/BBB/DDD. The model's time is the
/// machine's. After an unplugging, pending transfers end with -ESHUTDOWN, then everything is -ENODEV, as in the kernel.
class UsbfsNode final : public Node {
 public:
  explicit UsbfsNode(hal::wire::UsbWireModel& model, std::string kernel_driver = {});
  ~UsbfsNode() override;

  long on_ioctl(int fd, unsigned long request, void* argument) override;
  void service() override;

  /// Runs with nobody else in the model.
  template <class Do>
  auto with_model(Do&& act) {
    const std::lock_guard hold(mutex_);
    return act();
  }
  void unplug();
  /// Unplugs when the `count`-th transfer from now on is handed in: 1 is the next one. It is not carried out.
  void unplug_at_transfer(unsigned count);
  [[nodiscard]] unsigned transfers() const;         ///< handed in so far
  [[nodiscard]] std::string kernel_driver() const;  ///< bound to the interface now

 private:
  struct Urb;
  long submit(void* argument);
  long reap(void* argument);
  long discard(void* argument);
  long claim(int fd);
  bool carry_out(Urb& urb);
  void finish(Urb urb);
  void advance();
  void serve();
  void pull();
  long driver_request(void* argument);

  mutable std::mutex mutex_;
  hal::wire::UsbWireModel& model_;
  std::string driver_, detached_;
  std::optional<int> claimed_by_;
  std::deque<Urb> pending_, done_;
  Time served_at_{};
  unsigned transfers_ = 0, unplug_at_ = 0;
  bool gone_ = false;
};

}  // namespace tandem::test
