#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/model_node.h"

namespace tandem::test {

/// /dev/hidrawN in front of a device model. The queue holds 64 reports and then drops the newest, as the kernel's does.
class HidrawNode final : public ModelNode<hal::emulation::EmulatedHidDevice> {
 public:
  static constexpr std::size_t kQueueMax = 64;
  explicit HidrawNode(hal::emulation::EmulatedHidDevice& model);
  ~HidrawNode() override;

  long on_ioctl(int fd, unsigned long request, void* argument) override;
  ssize_t on_read(void* into, std::size_t size) override;
  ssize_t on_write(const void* from, std::size_t size) override;
  std::optional<short> on_poll(int timeout_ms) override;
  void service() override;

 private:
  void serve();
  void end_transfers() override;

  bool numbered_;
  std::deque<std::vector<std::byte>> queue_;
  std::condition_variable_any changed_;  ///< data to read, or unplugged
};

}  // namespace tandem::test
