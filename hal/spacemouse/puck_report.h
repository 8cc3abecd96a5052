#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>

#include "hal/device.h"

namespace tandem::hal::spacemouse {

/// Longest report that a SpaceMouse sends or takes, with its id.
inline constexpr std::size_t kPuckReportMax = 64;

/// One input report. A report tells only what it carries; nothing of what it does not.
struct PuckReport {
  std::optional<std::array<std::int16_t, 3>> shift;  ///< x, y, z in the maker's frame, counts
  std::optional<std::array<std::int16_t, 3>> turn;   ///< rx, ry, rz
  std::optional<std::uint32_t> buttons;              ///< bit mask, 1 = pressed
  std::optional<std::uint8_t> battery_percent;

  friend bool operator==(const PuckReport&, const PuckReport&) = default;
};

/// Decoded by report id and length, not by product: the same product was seen with both layouts.
///   id 1, 7 bytes: shift; id 1, 13 bytes: shift and turn; id 2, 7 bytes: turn; id 3, 3 to 5 bytes: buttons;
///   id 0x17, 3 bytes or more: battery; id 0x1C, 13 bytes: the usages of up to six buttons that are pressed (SpaceMouse Enterprise),
///   as a mask by enterprise_button; an unknown usage counts for none. Numbers are int16, little endian. Other ids: a report that tells
///   nothing; so does 0x1D, six usages whose meaning (pressed long?) nobody confirmed.
/// @return kFraming for a known id of another length, and for an empty report
[[nodiscard]] std::expected<PuckReport, Errc> parse_puck_report(std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

/// Bit of a button of the SpaceMouse Enterprise by its HID usage (page 9); nothing: no such button. Numbered 0..30 as spacenavd does
/// (src/dev.c, bnhack_sment, whose codes are 255 + usage): 0..11 the keys 1 to 12, 12 menu, 13 fit, 14..17 T R F and turn, 18..22 esc alt
/// shift ctrl lock, 23..26 enter delete tab space, 27..29 V1 V2 V3, 30 iso.
[[nodiscard]] std::optional<unsigned> enterprise_button(std::uint16_t usage) noexcept TANDEM_REALTIME;

/// The output report that switches the light: id 4 and one byte.
[[nodiscard]] constexpr std::array<std::byte, 2> light_report(bool on) noexcept {
  return {std::byte{4}, on ? std::byte{1} : std::byte{0}};
}

}  // namespace tandem::hal::spacemouse
