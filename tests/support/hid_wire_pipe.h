#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/pipes.h"
#include "hal/wire/wire_model.h"

namespace tandem::test {

/// Virtual time of one device: waiting is what moves the model.
class WireTime final : public hal::Clock {
 public:
  explicit WireTime(hal::wire::WireModel& model) noexcept : model_(model) {}
  [[nodiscard]] Time now() noexcept override { return now_; }
  void wait_until(Time at) noexcept override {
    if (at > now_) model_.advance(at - now_), now_ = at;
  }

 private:
  hal::wire::WireModel& model_;
  Time now_{};
};

/// A hidraw node without a kernel: reports go straight to and from the model; a read that waits polls every 50 us.
class HidWirePipe final : public hal::HidPipe {
 public:
  HidWirePipe(hal::wire::HidWireModel& model, WireTime& time) noexcept : model_(model), time_(time) {}

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
      if (moved.error() != hal::wire::WireStatus::kNak) return std::unexpected(error_of(moved.error()));
      if (time_.now() >= until) return std::size_t{0};
      time_.wait_until(std::min(until, time_.now() + std::chrono::microseconds{50}));
    }
  }
  /// The cable is pulled just before the call after `calls` more reads and writes.
  void unplug_after(int calls) noexcept { unplug_after_ = calls; }

 private:
  static hal::Errc error_of(hal::wire::WireStatus status) noexcept {
    return status == hal::wire::WireStatus::kGone ? hal::Errc::kUnplugged : hal::Errc::kProtocol;
  }

  hal::wire::HidWireModel& model_;
  WireTime& time_;
  std::optional<int> unplug_after_;
};

/// Somebody who waits without asking to give up, or gives up at once.
struct QuietBringUp final : hal::BringUp {
  explicit QuietBringUp(bool gives_up = false) : give_up(gives_up) {}
  void progress(std::string_view, double) override { ++told; }
  [[nodiscard]] bool cancelled() const noexcept override { return give_up; }
  bool give_up;
  int told = 0;
};

}  // namespace tandem::test
