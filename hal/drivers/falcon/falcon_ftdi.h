#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/core/pipes.h"

/// Serial line inside a Falcon: an FTDI USB bridge whose requests and packets are public (drivers of several systems).
namespace tandem::hal {

inline constexpr std::uint16_t kFalconVendor = 0x0403, kFalconProduct = 0xCB48;
inline constexpr std::uint8_t kFalconOut = 0x02, kFalconIn = 0x81;  ///< bulk endpoints
inline constexpr std::size_t kFtdiPacket = 64;                      ///< [bytes]
inline constexpr std::size_t kFtdiPayload = kFtdiPacket - 2;

/// Values of bRequest and wValue of the bridge.
namespace ftdi {
inline constexpr std::uint8_t kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kFormat = 4, kLatency = 9;
inline constexpr std::uint16_t kPurgeIn = 1, kPurgeOut = 2;
inline constexpr std::uint16_t kDtrLow = 0x0100, kDtrHigh = 0x0101, kRtsLow = 0x0200, kRtsHigh = 0x0202;
inline constexpr std::uint16_t k8N1 = 0x0008;
inline constexpr std::uint16_t k9600 = 0x4138, k143k = 0x0015, k1500k = 0x0002;  ///< divisors of 3 MHz
inline constexpr std::uint8_t kCts = 0x10;                                       ///< bit of the first status byte
inline constexpr std::uint8_t kLineErrors = 0x0E;  ///< bits of the second status byte: overrun, parity, framing
}  // namespace ftdi

/// One packet from the bridge: two status bytes, then the bytes received on the serial line.
struct FtdiPacket {
  bool whole = false;  ///< both status bytes are present
  bool cts = false;
  bool line_error = false;  ///< bytes were lost on the serial line
  std::span<const std::byte> payload;
};
[[nodiscard]] FtdiPacket ftdi_packet(std::span<const std::byte> packet) noexcept;

using LineResult = std::expected<void, Errc>;

/// Configures the line for the boot loader: both directions emptied, 9600 baud, flow control off. A DTR pulse restarts
/// the boot loader.
LineResult line_for_boot(UsbPipe& pipe) noexcept;
/// Configures the line for the firmware image: DTR low, 142.9 kBd.
LineResult line_for_image(UsbPipe& pipe) noexcept;
/// Configures the line for the servo: 1.5 MBd, replies flushed after 1 ms, both directions emptied.
LineResult line_for_servo(UsbPipe& pipe) noexcept;

}  // namespace tandem::hal
