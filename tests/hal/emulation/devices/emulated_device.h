#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "common/base/time.h"

/// Emulated devices as seen by the bus: the bytes at the plug, with the physics behind them. One model per kind of
/// device.
/// Thin adapters connect a model to a pipe in the same process, an ioctl of libusb, a hidraw node, a USB/IP server or
/// uhid.
/// A model has no clock: its time advances only by `advance`. Use from one thread at a time.
namespace tandem::hal::emulation {

enum class TransferStatus : std::uint8_t {
  kNak,    ///< nothing now: retry after time has advanced (an IN transfer stays pending, an OUT transfer waits)
  kStall,  ///< the endpoint answers STALL until CLEAR_FEATURE(ENDPOINT_HALT); for a control request: unsupported
  kGone,   ///< unplugged: no transfer succeeds until plugged in
};
/// Number of bytes transferred, or the status.
using TransferResult = std::expected<std::size_t, TransferStatus>;

/// The eight bytes of a control request, numbers converted to host byte order.
struct SetupPacket {
  std::uint8_t request_type = 0;  ///< bit 7: device to host
  std::uint8_t request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};
/// Parses a setup packet (little endian).
[[nodiscard]] constexpr SetupPacket setup_from(std::span<const std::byte, 8> b) noexcept {
  const auto u8 = [&](std::size_t i) { return static_cast<std::uint8_t>(b[i]); };
  const auto u16 = [&](std::size_t i) { return static_cast<std::uint16_t>(u8(i) | (u8(i + 1) << 8)); };
  return {u8(0), u8(1), u16(2), u16(4), u16(6)};
}

/// Interface common to USB and HID devices.
struct EmulatedDevice {
  virtual ~EmulatedDevice() = default;
  /// Advances the device's time: its firmware, timers and physics. `dt` is never negative. No heap.
  virtual void advance(Duration dt) noexcept = 0;
  /// Unplugs the device: every call returns kGone from now on. The model decides the behaviour of the motors.
  virtual void unplug() noexcept = 0;
  /// Plugs the device in again: a new device on the bus, halts cleared. The model decides whether the device lost
  /// power.
  virtual void plug_in() noexcept = 0;
  [[nodiscard]] virtual bool plugged_in() const noexcept = 0;
};

/// A USB device with one configuration and one interface.
struct EmulatedUsbDevice : EmulatedDevice {
  /// Returns the device descriptor, 18 bytes as on the bus.
  [[nodiscard]] virtual std::span<const std::byte> device_descriptor() const noexcept = 0;
  /// Returns the configuration with its interface and endpoints, wTotalLength bytes as on the bus.
  [[nodiscard]] virtual std::span<const std::byte> config_descriptor() const noexcept = 0;
  /// Returns the ASCII text of string descriptor `index` (1..); empty: none. Adapters convert it to UTF-16.
  [[nodiscard]] virtual std::string_view string(std::uint8_t index) const noexcept = 0;
  /// Handles class, vendor and CLEAR_FEATURE(ENDPOINT_HALT) requests. The adapter handles the other standard requests
  /// (descriptors, address, configuration).
  /// @param data  received data (host to device) or space for the reply (device to host)
  /// @return number of bytes of the data stage
  virtual TransferResult control(const SetupPacket& setup, std::span<std::byte> data) noexcept = 0;
  /// Handles one OUT transfer to endpoint `ep` (0x02): takes all bytes or returns a status. @param bytes  of the whole
  /// transfer, any length
  virtual TransferResult bulk_out(std::uint8_t ep, std::span<const std::byte> bytes) noexcept = 0;
  /// Returns one packet of IN endpoint `ep` (0x81), at most the endpoint's packet size, or kNak.
  /// A short packet (below the packet size) ends a transfer. An adapter with a larger buffer requests more only after a
  /// full packet.
  virtual TransferResult bulk_in(std::uint8_t ep, std::span<std::byte> into) noexcept = 0;
};

/// A HID device. Reports begin with the report id if the descriptor has ids, else they have none.
struct EmulatedHidDevice : EmulatedDevice {
  [[nodiscard]] virtual std::uint16_t vendor_id() const noexcept = 0;
  [[nodiscard]] virtual std::uint16_t product_id() const noexcept = 0;
  [[nodiscard]] virtual std::string_view manufacturer() const noexcept = 0;
  [[nodiscard]] virtual std::string_view product() const noexcept = 0;
  [[nodiscard]] virtual std::string_view serial() const noexcept = 0;
  [[nodiscard]] virtual std::span<const std::byte> report_descriptor() const noexcept = 0;
  virtual TransferResult report_out(std::span<const std::byte> report) noexcept = 0;
  /// Returns the oldest queued report, or kNak.
  virtual TransferResult report_in(std::span<std::byte> into) noexcept = 0;
  /// Handles a SET_FEATURE. @param report  begins with the report id (0 if the descriptor has none)
  virtual TransferResult feature_set(std::span<const std::byte> report) noexcept = 0;
  /// Handles a GET_FEATURE. @param into  the first byte selects the report; the reply begins with it
  virtual TransferResult feature_get(std::span<std::byte> into) noexcept = 0;
};

}  // namespace tandem::hal::emulation
