#pragma once

#include <cstdint>
#include <memory>

#include "hal/core/pipes.h"
#include "hal/io/enumeration.h"

namespace tandem::hal {

/// Interface of a USB device and its bulk endpoints.
struct UsbInterface {
  int number = 0;
  std::uint8_t in = 0x81, out = 0x02;  ///< bulk endpoints
};

/// A USB interface through libusb.
/// Every pipe has its own libusb context and handles its events on the waiting thread. No event thread can therefore
/// race with closing or unplugging.
/// From the first read on, one IN transfer is always in flight. A packet may arrive between calls, and none is lost to
/// a cancellation.
/// After opening, the pipe allocates nothing; libusb's own bookkeeping of a transfer does. Once the device is
/// unplugged, every call returns kUnplugged at once.
class LibusbPipe final : public UsbPipe {
 public:
  static constexpr std::size_t kWriteMax = 4096;                 ///< longer writes: kInternal
  static constexpr Duration kTimeout = std::chrono::seconds(1);  ///< time-out of control requests and cancellations

  /// Opens and claims the interface. A kernel driver that holds it is detached while the pipe exists.
  /// Error: kPermission with the udev rule, kBusy with the possible holders, kUnplugged, kUnsupported (other
  /// endpoints).
  [[nodiscard]] static Result<std::unique_ptr<LibusbPipe>> open(const AttachedDevice& device,
                                                                UsbInterface interface = {});
  ~LibusbPipe() override;

  std::expected<void, Errc> control(std::uint8_t request, std::uint16_t value, std::uint16_t index) noexcept override;
  /// kTimeout means that no byte was sent; a partial write counts as success.
  Moved write(std::span<const std::byte> bytes, Duration timeout) noexcept override;
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override;
  std::expected<void, Errc> clear_halt() noexcept override;

 private:
  struct Impl;
  explicit LibusbPipe(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tandem::hal
