#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <vector>

#include "common/base/time.h"
#include "hal/wire/wire_model.h"
#include "tests/hal/emulation/node.h"

namespace tandem::test {

/// /dev/hidrawN in front of a wire model. The queue of reports holds 64 and then forgets the newest, as the kernel's.
/// The model's time is the machine's.
class HidrawNode final : public Node {
 public:
  static constexpr std::size_t kQueueMax = 64;
  explicit HidrawNode(hal::wire::HidWireModel& model);
  ~HidrawNode() override;

  long on_ioctl(int fd, unsigned long request, void* argument) override;
  ssize_t on_read(void* into, std::size_t size) override;
  ssize_t on_write(const void* from, std::size_t size) override;
  void service() override;

  template <class Do>
  auto with_model(Do&& act) {
    const std::lock_guard hold(mutex_);
    return act();
  }
  void unplug();
  /// Unplugs at the `count`-th report written from now on, which the device does not get.
  void unplug_at_write(unsigned count);

 private:
  void serve();
  void pull();

  std::mutex mutex_;
  hal::wire::HidWireModel& model_;
  bool numbered_;
  std::deque<std::vector<std::byte>> queue_;
  Time served_at_{};
  unsigned writes_ = 0, unplug_at_ = 0;
  bool gone_ = false;
};

}  // namespace tandem::test
