#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/time.h"
#include "hal/core/device.h"

/// Bus interfaces of the drivers. Implementations are in hal/io (libusb, hidapi) and in tests.
/// One thread at a time uses a pipe. No function throws or allocates. Errors: kUnplugged, kTimeout, kPermission, kBusy,
/// kProtocol (stall), kInternal.
namespace tandem::hal {

/// Number of bytes transferred, or the error. Reading: 0 means that no data arrived in time.
using Moved = std::expected<std::size_t, Errc>;

/// A vendor-class USB interface with one bulk endpoint per direction and control requests.
struct UsbPipe {
  virtual ~UsbPipe() = default;
  /// Sends a vendor request without data, host to device (bmRequestType 0x40).
  virtual std::expected<void, Errc> control(std::uint8_t request, std::uint16_t value,
                                            std::uint16_t index) noexcept = 0;
  virtual Moved write(std::span<const std::byte> bytes, Duration timeout) noexcept = 0;
  /// Reads one complete packet; `into` holds at least the endpoint's packet size.
  virtual Moved read(std::span<std::byte> into, Duration timeout) noexcept = 0;
  /// Clears a stall of both endpoints.
  virtual std::expected<void, Errc> clear_halt() noexcept = 0;
};

/// A HID interface. Reports begin with the report id if the device uses ids.
/// Otherwise they have none, and the pipe adds hidapi's leading zero.
struct HidPipe {
  virtual ~HidPipe() = default;
  virtual Moved write(std::span<const std::byte> report) noexcept = 0;
  /// Reads the oldest queued report. For a device that sends unprompted, the newest is the last one before a call
  /// returns 0.
  virtual Moved read(std::span<std::byte> into, Duration timeout) noexcept = 0;
};

}  // namespace tandem::hal
