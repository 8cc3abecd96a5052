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
///   id 0x17, 3 bytes or more: battery. Numbers are int16, little endian. Other ids: a report that tells nothing.
/// @return kFraming for a known id of another length, and for an empty report
[[nodiscard]] std::expected<PuckReport, Errc> parse_puck_report(std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

/// The output report that switches the light: id 4 and one byte.
[[nodiscard]] constexpr std::array<std::byte, 2> light_report(bool on) noexcept {
  return {std::byte{4}, on ? std::byte{1} : std::byte{0}};
}

}  // namespace tandem::hal::spacemouse
