#include "hal/drivers/woodenhaptics/board_report.h"

#include <algorithm>

namespace tandem::hal::woodenhaptics {
namespace {

constexpr std::int16_t kButtonLatched = 1;
constexpr std::int16_t kPresetCounters = 1;

std::int16_t word(std::span<const std::byte> bytes, std::size_t i) noexcept {
  const auto low = std::to_integer<unsigned>(bytes[2 * i]);
  const auto high = std::to_integer<unsigned>(bytes[2 * i + 1]);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | (high << 8)));
}

void put_word(std::span<std::byte, kReportMax> bytes, std::size_t i, std::int16_t value) noexcept {
  const auto u = static_cast<std::uint16_t>(value);
  bytes[2 * i] = static_cast<std::byte>(u & 0xff);
  bytes[2 * i + 1] = static_cast<std::byte>(u >> 8);
}

}  // namespace

std::expected<BoardReport, Errc> parse_report(WoodenProtocol protocol, bool stylus_on_encoder_d,
                                              std::span<const std::byte> bytes) noexcept {
  if (bytes.size() != report_size(protocol)) return std::unexpected(Errc::kFraming);
  BoardReport report;
  if (!has_presets(protocol)) {
    for (std::size_t i = 0; i < 3; ++i) report.counts[i] = word(bytes, i);
    return report;
  }
  for (std::size_t i = 0; i < kEncoders; ++i) report.counts[i] = word(bytes, i);
  report.calibration_pressed = word(bytes, kEncoders) == kButtonLatched;
  if (stylus_on_encoder_d && report.counts[3] > kStylusOffset / 2) {
    report.stylus_pressed = true;
    report.counts[3] = static_cast<std::int16_t>(report.counts[3] - kStylusOffset);
  }
  return report;
}

std::size_t write_command(WoodenProtocol protocol, const BoardCommand& command,
                          std::span<std::byte, kReportMax> into) noexcept {
  std::ranges::fill(into, std::byte{0});
  if (!command.preset) {
    for (std::size_t i = 0; i < 3; ++i) put_word(into, i, command.current_ma[i]);
  } else if (has_presets(protocol)) {
    // In this command the fields of the currents carry the gimbal's counts and drive no motor.
    for (std::size_t i = 0; i < 3; ++i) put_word(into, i, command.counts[3 + i]);
    put_word(into, 3, kPresetCounters);
    for (std::size_t i = 0; i < 3; ++i) put_word(into, 4 + i, command.counts[i]);
  }
  return report_size(protocol);
}

}  // namespace tandem::hal::woodenhaptics
