#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>

#include "hal/core/device.h"

namespace tandem::hal::spacemouse {

/// Longest report that a SpaceMouse sends or accepts, including its id [bytes].
inline constexpr std::size_t kSpaceMouseReportMax = 64;

/// One input report. Empty members are not part of the report.
struct SpaceMouseReport {
  std::optional<std::array<std::int16_t, 3>> translation;  ///< x, y, z in the maker's frame, counts
  std::optional<std::array<std::int16_t, 3>> rotation;     ///< rx, ry, rz
  std::optional<std::uint32_t> buttons;                    ///< bit mask, 1 = pressed
  std::optional<std::uint8_t> battery_percent;

  friend bool operator==(const SpaceMouseReport&, const SpaceMouseReport&) = default;
};

/// Parses a report by report id and length, not by product: both layouts were seen on the same product.
///   id 1, 7 bytes: translation; id 1, 13 bytes: translation and rotation; id 2, 7 bytes: rotation;
///   id 3, 3 to 5 bytes: buttons; id 0x17, 3 bytes or more: battery;
///   id 0x1C, 13 bytes: the usages of up to six pressed buttons (SpaceMouse Enterprise), as a mask by
///   enterprise_button.
/// Numbers are int16, little endian. Unknown usages are ignored. Other ids give an empty report.
/// 0x1D gives one too: six usages of unconfirmed meaning (long presses?).
/// @return kFraming for a known id of another length, and for an empty report
[[nodiscard]] std::expected<SpaceMouseReport, Errc> parse_spacemouse_report(std::span<const std::byte> bytes) noexcept
    TANDEM_REALTIME;

/// Returns the bit of a button of the SpaceMouse Enterprise by its HID usage (page 9); empty: no such button.
/// Numbered 0..30 as in spacenavd (src/dev.c, bnhack_sment, whose codes are 255 + usage): 0..11 the keys 1 to 12, 12
/// menu, 13 fit, 14..17 T R F and turn, 18..22 esc alt shift ctrl lock, 23..26 enter delete tab space, 27..29 V1 V2 V3,
/// 30 iso.
[[nodiscard]] std::optional<unsigned> enterprise_button(std::uint16_t usage) noexcept TANDEM_REALTIME;

/// Returns the output report that switches the light: id 4 and one byte.
[[nodiscard]] constexpr std::array<std::byte, 2> light_report(bool on) noexcept {
  return {std::byte{4}, on ? std::byte{1} : std::byte{0}};
}

}  // namespace tandem::hal::spacemouse
