#pragma once

#include <cstdint>
#include <memory>

#include "hal/io/attached.h"
#include "hal/pipes.h"

namespace tandem::hal {

/// Which part of a USB device is meant.
struct UsbInterface {
  int number = 0;
  std::uint8_t in = 0x81, out = 0x02;  ///< bulk endpoints
};

/// A USB interface through libusb. Every pipe has a libusb context of its own and handles its events on the thread that
/// waits, so no event thread can race with closing or unplugging. From the first reading on one is always under way: a
/// packet may come while nobody waits, and none is lost to a cancellation. After opening, nothing of ours is taken from the heap (libusb's own
/// bookkeeping of a transfer is). Once unplugged, every call says so at once.
class LibusbPipe final : public UsbPipe {
 public:
  static constexpr std::size_t kWriteMax = 4096;                  ///< longer writes: kInternal
  static constexpr Duration kPatience = std::chrono::seconds(1);  ///< for control requests and cancellations

  /// Opens and claims; a kernel driver that holds the interface is detached while the pipe lives.
  /// Error: kPermission with the udev rule, kBusy with what can hold it, kUnplugged, kUnsupported (other endpoints).
  [[nodiscard]] static Result<std::unique_ptr<LibusbPipe>> open(const Attached& device, UsbInterface interface = {});
  ~LibusbPipe() override;

  std::expected<void, Errc> control(std::uint8_t request, std::uint16_t value, std::uint16_t index) noexcept override;
  /// After kTimeout nothing of `bytes` was taken; a part that was taken counts as success.
  Moved write(std::span<const std::byte> bytes, Duration timeout) noexcept override;
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override;
  std::expected<void, Errc> clear_halt() noexcept override;

 private:
  struct Impl;
  explicit LibusbPipe(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tandem::hal
