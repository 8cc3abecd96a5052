#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/core/pipes.h"
#include "tests/hal/emulation/devices/emulated_device.h"

namespace tandem::test {

/// Virtual time of one device: waiting advances the model.
class HidModelClock final : public hal::Clock {
 public:
  explicit HidModelClock(hal::emulation::EmulatedDevice& model) noexcept : model_(model) {}
  [[nodiscard]] Time now() noexcept override { return now_; }
  void wait_until(Time at) noexcept override {
    if (at > now_) model_.advance(at - now_), now_ = at;
  }

 private:
  hal::emulation::EmulatedDevice& model_;
  Time now_{};
};

/// A hidraw node without a kernel: reports pass directly to and from the model. A waiting read polls every 50 us.
class HidModelPipe final : public hal::HidPipe {
 public:
  HidModelPipe(hal::emulation::EmulatedHidDevice& model, HidModelClock& time) noexcept : model_(model), time_(time) {}

  hal::Moved write(std::span<const std::byte> report) noexcept override {
    if (unplug_after_ && --*unplug_after_ < 0) model_.unplug();
    time_.wait_until(time_.now() + std::chrono::microseconds{100});
    const auto moved = model_.report_out(report);
    if (!moved) return std::unexpected(error_of(moved.error()));
    return *moved;
  }
  hal::Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    if (unplug_after_ && --*unplug_after_ < 0) model_.unplug();
    const Time until = time_.now() + timeout;
    while (true) {
      const auto moved = model_.report_in(into);
      if (moved) return *moved;
      if (moved.error() != hal::emulation::TransferStatus::kNak) return std::unexpected(error_of(moved.error()));
      if (time_.now() >= until) return std::size_t{0};
      time_.wait_until(std::min(until, time_.now() + std::chrono::microseconds{50}));
    }
  }
  /// Unplugs the device just before the call after `calls` more reads and writes.
  void unplug_after(int calls) noexcept { unplug_after_ = calls; }

 private:
  static hal::Errc error_of(hal::emulation::TransferStatus status) noexcept {
    return status == hal::emulation::TransferStatus::kGone ? hal::Errc::kUnplugged : hal::Errc::kProtocol;
  }

  hal::emulation::EmulatedHidDevice& model_;
  HidModelClock& time_;
  std::optional<int> unplug_after_;
};

/// Observer of a bring-up that never cancels, or cancels at once.
struct QuietBringUp final : hal::BringUp {
  explicit QuietBringUp(bool gives_up = false) : give_up(gives_up) {}
  void progress(std::string_view, double) override { ++told; }
  [[nodiscard]] bool cancelled() const noexcept override { return give_up; }
  bool give_up;
  int told = 0;
};

}  // namespace tandem::test
