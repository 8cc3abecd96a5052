#include "hal/drivers/spacemouse/spacemouse_report.h"

namespace tandem::hal::spacemouse {
namespace {

constexpr std::byte kShift{1}, kTurn{2}, kButtons{3}, kBattery{0x17}, kPressed{0x1C};
constexpr std::size_t kPressedMost = 6;

std::array<std::int16_t, 3> three(std::span<const std::byte> bytes, std::size_t from) noexcept {
  std::array<std::int16_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto low = std::to_integer<unsigned>(bytes[from + 2 * i]);
    const auto high = std::to_integer<unsigned>(bytes[from + 2 * i + 1]);
    out[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(low | (high << 8)));
  }
  return out;
}

}  // namespace

std::optional<unsigned> enterprise_button(std::uint16_t usage) noexcept {
  const auto among = [usage](unsigned first, unsigned last) { return usage >= first && usage <= last; };
  if (among(13, 22)) return usage - 13U;             // 1 to 10
  if (among(77, 78)) return 10U + (usage - 77U);     // 11, 12
  if (among(1, 3)) return 12U + (usage - 1U);        // menu, fit, T
  if (among(5, 6)) return 15U + (usage - 5U);        // R, F
  if (usage == 9) return 17U;                        // turn
  if (among(23, 27)) return 18U + (usage - 23U);     // esc, alt, shift, ctrl, lock
  if (among(36, 37)) return 23U + (usage - 36U);     // enter, delete
  if (among(175, 176)) return 25U + (usage - 175U);  // tab, space
  if (among(103, 105)) return 27U + (usage - 103U);  // V1, V2, V3
  if (usage == 11) return 30U;                       // iso
  return std::nullopt;
}

std::expected<SpaceMouseReport, Errc> parse_spacemouse_report(std::span<const std::byte> bytes) noexcept {
  const std::size_t n = bytes.size();
  if (n == 0) return std::unexpected(Errc::kFraming);
  SpaceMouseReport report;
  if (bytes[0] == kShift && (n == 7 || n == 13)) {
    report.translation = three(bytes, 1);
    if (n == 13) report.rotation = three(bytes, 7);
  } else if (bytes[0] == kTurn && n == 7) {
    report.rotation = three(bytes, 1);
  } else if (bytes[0] == kButtons && n >= 3 && n <= 5) {
    std::uint32_t mask = 0;
    for (std::size_t i = 1; i < n; ++i) mask |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * (i - 1));
    report.buttons = mask;
  } else if (bytes[0] == kBattery && n >= 3) {
    report.battery_percent = std::to_integer<std::uint8_t>(bytes[1]);
  } else if (bytes[0] == kPressed && n == 1 + 2 * kPressedMost) {
    std::uint32_t mask = 0;
    for (std::size_t i = 0; i < kPressedMost; ++i) {
      const unsigned usage = std::to_integer<unsigned>(bytes[1 + 2 * i]) | std::to_integer<unsigned>(bytes[2 + 2 * i])
                                                                               << 8;
      if (const auto bit = enterprise_button(static_cast<std::uint16_t>(usage))) mask |= 1U << *bit;
    }
    report.buttons = mask;
  } else if (bytes[0] == kPressed || bytes[0] == kShift || bytes[0] == kTurn || bytes[0] == kButtons ||
             bytes[0] == kBattery) {
    return std::unexpected(Errc::kFraming);
  }
  return report;
}

}  // namespace tandem::hal::spacemouse
