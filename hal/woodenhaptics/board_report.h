#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "hal/device.h"
#include "proto/woodenhaptics_spec.h"

/// The bytes between a WoodenHaptics board and its host: little-endian int16, no report id.
///   device to host  v1: encoders a b c, counter (8 B). v2: encoders a..f, info (14 B). raw64: v2 padded to 64 B.
///   host to device  v1: currents a b c [mA], 0 (8 B). v2: currents a b c, command, attributes 0 1 2 (14 B). raw64 alike.
/// Source: restated from the boards' published firmware and host library (haptikfabrikenapi).
namespace tandem::hal::woodenhaptics {

inline constexpr std::size_t kReportMax = 64;
inline constexpr std::size_t kEncoders = 6;
/// What some boards add to encoder d while the stylus' button is held; above half of it the button counts as held.
inline constexpr int kStylusOffset = 10000;

/// Bytes of a report, each way.
[[nodiscard]] constexpr std::size_t report_size(WoodenProtocol protocol) noexcept {
  return protocol == WoodenProtocol::kV1 ? 8 : protocol == WoodenProtocol::kV2 ? 14 : kReportMax;
}
/// Whether the board has a command that presets its counters, and a calibration button.
[[nodiscard]] constexpr bool has_presets(WoodenProtocol protocol) noexcept { return protocol != WoodenProtocol::kV1; }

struct BoardReport {
  std::array<std::int16_t, kEncoders> counts{};  ///< motors a b c, then the gimbal's d e f (v1: 0)
  bool calibration_pressed = false;              ///< latched by the board until counters are preset
  bool stylus_pressed = false;

  friend bool operator==(const BoardReport&, const BoardReport&) = default;
};

/// @param stylus_on_encoder_d  take the button out of encoder d
/// @return kFraming for any other length than the protocol's; every content of the right length is a report
[[nodiscard]] std::expected<BoardReport, Errc> parse_report(WoodenProtocol protocol, bool stylus_on_encoder_d,
                                                            std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

struct BoardOrder {
  std::array<std::int16_t, 3> current_ma{};       ///< of the motors, as the firmware understands milliamperes
  bool preset = false;                            ///< set the counters to `counts` instead; this frame drives no motor
  std::array<std::int16_t, kEncoders> counts{};   ///< only with `preset`
};

/// @return the bytes written, `report_size(protocol)`. A v1 board knows no presets: its frame is all zero then.
std::size_t write_order(WoodenProtocol protocol, const BoardOrder& order,
                        std::span<std::byte, kReportMax> into) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal::woodenhaptics
