#pragma once

#include <mutex>
#include <thread>

#include "common/io/fd.h"
#include "hal/wire/wire_model.h"

namespace tandem::test {

/// Above every servo.
inline constexpr int kDevicePriority = 90;

/// A wire model as a HID device of the real kernel, through /dev/uhid. Needs root and the module. The model's time is
/// the machine's.
class UhidDevice {
 public:
  /// @param raster  how often the device is looked after
  explicit UhidDevice(hal::wire::HidWireModel& model, Duration raster = std::chrono::microseconds(50));
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

  hal::wire::HidWireModel& model_;
  Duration raster_;
  io::Fd fd_;
  bool numbered_;
  std::mutex mutex_;
  Time served_at_{};
  std::jthread thread_;
};

}  // namespace tandem::test
