#pragma once

#include <mutex>
#include <thread>

#include "common/io/fd.h"
#include "tests/hal/emulation/devices/emulated_device.h"

namespace tandem::test {

/// Real-time priority of emulated devices: above every servo.
inline constexpr int kDevicePriority = 90;

/// Presents an emulated device as a HID device to the real kernel, through /dev/uhid. Needs root and the kernel module.
/// The model's time follows the machine's clock.
class UhidDevice {
 public:
  /// @param raster  period in which the model advances and sends its reports
  explicit UhidDevice(hal::emulation::EmulatedHidDevice& model, Duration raster = std::chrono::microseconds(50));
  ~UhidDevice();
  UhidDevice(const UhidDevice&) = delete;

  [[nodiscard]] bool attached() const { return fd_.open(); }
  void unplug();

  template <class Do>
  auto with_model(Do&& act) {
    const std::lock_guard hold(mutex_);
    return act();
  }

 private:
  void serve(std::stop_token stop);
  bool take_event();
  void send_reports();

  hal::emulation::EmulatedHidDevice& model_;
  Duration raster_;
  io::Fd fd_;
  bool numbered_;
  std::mutex mutex_;
  Time served_at_{};
  std::jthread thread_;
};

}  // namespace tandem::test
