#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "hal/core/device.h"
#include "proto/spec/woodenhaptics_spec.h"

/// Reports between a WoodenHaptics board and its host: little-endian int16, no report id.
///   device to host  v1: encoders a b c, counter (8 B). v2: encoders a..f, info (14 B). raw64: v2 padded to 64 B.
///   host to device  v1: currents a b c [mA], 0 (8 B). v2: currents a b c, command, attributes 0 1 2 (14 B).
///                   raw64: v2 padded to 64 B.
/// Source: restated from the boards' published firmware and host library (haptikfabrikenapi).
namespace tandem::hal::woodenhaptics {

inline constexpr std::size_t kReportMax = 64;
inline constexpr std::size_t kEncoders = 6;
/// Offset that some boards add to encoder d while the stylus button is pressed; above half of it the button counts as
/// pressed.
inline constexpr int kStylusOffset = 10000;

/// Returns the size of a report in both directions [bytes].
[[nodiscard]] constexpr std::size_t report_size(WoodenProtocol protocol) noexcept {
  return protocol == WoodenProtocol::kV1 ? 8 : protocol == WoodenProtocol::kV2 ? 14 : kReportMax;
}
/// Returns whether the board has a command that presets its counters, and a calibration button.
[[nodiscard]] constexpr bool has_presets(WoodenProtocol protocol) noexcept { return protocol != WoodenProtocol::kV1; }

struct BoardReport {
  std::array<std::int16_t, kEncoders> counts{};  ///< motors a b c, then the gimbal's d e f (v1: 0)
  bool calibration_pressed = false;              ///< latched by the board until counters are preset
  bool stylus_pressed = false;

  friend bool operator==(const BoardReport&, const BoardReport&) = default;
};

/// Parses a report of the board.
/// @param stylus_on_encoder_d  remove the button's offset from encoder d
/// @return kFraming for any other length than the protocol's; every content of the right length is a valid report
[[nodiscard]] std::expected<BoardReport, Errc> parse_report(WoodenProtocol protocol, bool stylus_on_encoder_d,
                                                            std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

struct BoardCommand {
  std::array<std::int16_t, 3> current_ma{};      ///< motor currents in the firmware's milliamperes
  bool preset = false;                           ///< set the counters to `counts`; this frame drives no motor
  std::array<std::int16_t, kEncoders> counts{};  ///< only with `preset`
};

/// Writes a command into `into`.
/// @return the bytes written, `report_size(protocol)`. A v1 board has no preset command: its frame is then all zero.
std::size_t write_command(WoodenProtocol protocol, const BoardCommand& command,
                          std::span<std::byte, kReportMax> into) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal::woodenhaptics
