#pragma once

#include <algorithm>
#include <chrono>

#include "hal/core/clock.h"
#include "hal/core/pipes.h"
#include "tests/hal/emulation/devices/emulated_device.h"

namespace tandem::hal::emulation {

/// Virtual time of one device model: waiting advances it.
class ModelClock final : public hal::Clock {
 public:
  explicit ModelClock(EmulatedDevice& model, Time start = Time{} + std::chrono::seconds(1)) noexcept
      : model_(&model), now_(start) {}
  [[nodiscard]] Time now() noexcept override { return now_; }
  void wait_until(Time at) noexcept override {
    if (at > now_) advance(at - now_);
  }
  void advance(Duration dt) noexcept {
    model_->advance(dt);
    now_ += dt;
  }

 private:
  EmulatedDevice* model_;
  Time now_;
};

/// A USB pipe directly into a device model, without a bus: for tests of drivers against models in virtual time.
class UsbModelPipe final : public UsbPipe {
 public:
  static constexpr Duration kSlice = std::chrono::microseconds(50);
  /// Approximate duration of a request or transfer on a full-speed bus; loops that only poll therefore make progress.
  static constexpr Duration kTransfer = std::chrono::microseconds(10);

  UsbModelPipe(EmulatedUsbDevice& model, ModelClock& clock, std::uint8_t out, std::uint8_t in) noexcept
      : model_(&model), clock_(&clock), out_(out), in_(in) {}

  std::expected<void, Errc> control(std::uint8_t request, std::uint16_t value, std::uint16_t index) noexcept override {
    clock_->advance(kTransfer);
    const TransferResult done = model_->control({0x40, request, value, index, 0}, {});
    return done ? std::expected<void, Errc>() : std::unexpected(errc(done.error()));
  }
  Moved write(std::span<const std::byte> bytes, Duration timeout) noexcept override {
    clock_->advance(kTransfer);
    return wait(timeout, false, [&] { return model_->bulk_out(out_, bytes); });
  }
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    return wait(timeout, true, [&] { return model_->bulk_in(in_, into); });
  }
  std::expected<void, Errc> clear_halt() noexcept override {
    for (const std::uint8_t ep : {out_, in_}) {
      const TransferResult done = model_->control({0x02, 1, 0, ep, 0}, {});
      if (!done) return std::unexpected(errc(done.error()));
    }
    return {};
  }

 private:
  static Errc errc(TransferStatus status) noexcept {
    return status == TransferStatus::kGone    ? Errc::kUnplugged
           : status == TransferStatus::kStall ? Errc::kProtocol
                                              : Errc::kTimeout;
  }
  template <class Transfer>
  Moved wait(Duration timeout, bool reading, Transfer transfer) noexcept {
    const Time until = clock_->now() + timeout;
    for (;;) {
      const TransferResult moved = transfer();
      if (moved) return *moved;
      if (moved.error() != TransferStatus::kNak) return std::unexpected(errc(moved.error()));
      const Duration left = until - clock_->now();
      if (left <= Duration{0}) return reading ? Moved(0) : std::unexpected(Errc::kTimeout);
      clock_->advance(std::min(left, kSlice));
    }
  }

  EmulatedUsbDevice* model_;
  ModelClock* clock_;
  std::uint8_t out_, in_;
};

}  // namespace tandem::hal::emulation
