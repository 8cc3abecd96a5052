#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/time.h"
#include "hal/device.h"

/// What a driver sees of a bus. Real ones stand in hal/io (libusb, hidapi), others in tests. One thread at a time uses a
/// pipe. Nothing here throws or takes memory; errors: kUnplugged, kTimeout, kPermission, kBusy, kProtocol (stall), kInternal.
namespace tandem::hal {

/// Bytes moved, or why not. Reading: 0 means that nothing came in time.
using Moved = std::expected<std::size_t, Errc>;

/// A vendor-class USB interface with one bulk endpoint each way and control requests.
struct UsbPipe {
  virtual ~UsbPipe() = default;
  /// A vendor request without data, host to device (bmRequestType 0x40).
  virtual std::expected<void, Errc> control(std::uint8_t request, std::uint16_t value, std::uint16_t index) noexcept = 0;
  virtual Moved write(std::span<const std::byte> bytes, Duration timeout) noexcept = 0;
  /// One packet, whole; `into` holds at least the endpoint's packet size.
  virtual Moved read(std::span<std::byte> into, Duration timeout) noexcept = 0;
  /// Ends a stall of both endpoints.
  virtual std::expected<void, Errc> clear_halt() noexcept = 0;
};

/// A HID interface. Reports are without report id where the device has none (the pipe adds hidapi's leading zero), else
/// they begin with it.
struct HidPipe {
  virtual ~HidPipe() = default;
  virtual Moved write(std::span<const std::byte> report) noexcept = 0;
  /// The oldest report that waits; of a device that sends by itself, call it until it returns 0 to have the newest.
  virtual Moved read(std::span<std::byte> into, Duration timeout) noexcept = 0;
};

}  // namespace tandem::hal
