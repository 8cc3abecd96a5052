#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "common/base/time.h"

/// Devices as the bus sees them: what goes in and out of the plug, byte for byte, with the physics behind it. One model per
/// kind of device; a pipe in the same process, an ioctl of libusb, a hidraw node, a USB/IP server or uhid are thin adapters
/// around the same model. A model knows no clock: its time is what `advance` was told. One thread at a time.
namespace tandem::hal::wire {

enum class WireStatus : std::uint8_t {
  kNak,    ///< nothing now: ask again after time went on (an IN transfer stays pending, an OUT transfer waits)
  kStall,  ///< the endpoint answers STALL until CLEAR_FEATURE(ENDPOINT_HALT); a control request: not understood
  kGone,   ///< unplugged: no answer ever again, until plugged in
};
/// Bytes moved, or why none.
using WireMoved = std::expected<std::size_t, WireStatus>;

/// The eight bytes of a control request, numbers already in the machine's order.
struct SetupPacket {
  std::uint8_t request_type = 0;  ///< bit 7: device to host
  std::uint8_t request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};
/// From the wire (little endian).
[[nodiscard]] constexpr SetupPacket setup_from(std::span<const std::byte, 8> b) noexcept {
  const auto u8 = [&](std::size_t i) { return static_cast<std::uint8_t>(b[i]); };
  const auto u16 = [&](std::size_t i) { return static_cast<std::uint16_t>(u8(i) | (u8(i + 1) << 8)); };
  return {u8(0), u8(1), u16(2), u16(4), u16(6)};
}

/// What both kinds share.
struct WireModel {
  virtual ~WireModel() = default;
  /// Moves the device's own time on: its firmware, timers and physics. Never negative. No heap.
  virtual void advance(Duration dt) noexcept = 0;
  /// Pulls the cable: everything answers kGone from now on. What the motors do then is the model's to say.
  virtual void unplug() noexcept = 0;
  /// Puts it back: a new device on the bus, halts cleared. Whether the device lost its power is the model's to say.
  virtual void plug_in() noexcept = 0;
  [[nodiscard]] virtual bool plugged_in() const noexcept = 0;
};

/// A USB device with one configuration, one interface.
struct UsbWireModel : WireModel {
  /// 18 bytes, as on the wire.
  [[nodiscard]] virtual std::span<const std::byte> device_descriptor() const noexcept = 0;
  /// Configuration with its interface and endpoints, wTotalLength bytes, as on the wire.
  [[nodiscard]] virtual std::span<const std::byte> config_descriptor() const noexcept = 0;
  /// ASCII text of string descriptor `index` (1..), empty if there is none. Adapters make UTF-16 of it.
  [[nodiscard]] virtual std::string_view string(std::uint8_t index) const noexcept = 0;
  /// Class, vendor and CLEAR_FEATURE(ENDPOINT_HALT) requests. Other standard requests (descriptors, address,
  /// configuration) are the adapter's. @param data what came (host to device) or room for the answer (device to host);
  /// returns its bytes.
  virtual WireMoved control(const SetupPacket& setup, std::span<std::byte> data) noexcept = 0;
  /// One OUT transfer to endpoint `ep` (0x02): all bytes or a status. @param bytes of the whole transfer, any length
  virtual WireMoved bulk_out(std::uint8_t ep, std::span<const std::byte> bytes) noexcept = 0;
  /// One packet of IN endpoint `ep` (0x81), at most the endpoint's packet size: what waits, or kNak. A short packet
  /// (below the packet size) ends a transfer; an adapter with a larger buffer asks again only after a full packet.
  virtual WireMoved bulk_in(std::uint8_t ep, std::span<std::byte> into) noexcept = 0;
};

/// A HID device. Reports are without report id where the descriptor has none, else they begin with it.
struct HidWireModel : WireModel {
  [[nodiscard]] virtual std::uint16_t vendor_id() const noexcept = 0;
  [[nodiscard]] virtual std::uint16_t product_id() const noexcept = 0;
  [[nodiscard]] virtual std::string_view manufacturer() const noexcept = 0;
  [[nodiscard]] virtual std::string_view product() const noexcept = 0;
  [[nodiscard]] virtual std::string_view serial() const noexcept = 0;
  [[nodiscard]] virtual std::span<const std::byte> report_descriptor() const noexcept = 0;
  virtual WireMoved report_out(std::span<const std::byte> report) noexcept = 0;
  /// The oldest report that waits, or kNak.
  virtual WireMoved report_in(std::span<std::byte> into) noexcept = 0;
  /// @param report  begins with the report id (0 where the descriptor has none)
  virtual WireMoved feature_set(std::span<const std::byte> report) noexcept = 0;
  /// @param into  the first byte says which; the answer begins with it
  virtual WireMoved feature_get(std::span<std::byte> into) noexcept = 0;
};

}  // namespace tandem::hal::wire
