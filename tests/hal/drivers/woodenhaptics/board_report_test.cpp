#include "hal/drivers/woodenhaptics/board_report.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/base/rng.h"
#include "hal/drivers/woodenhaptics/unwrapped_counter.h"
#include "tests/common/base/counts.h"

namespace tandem::hal::woodenhaptics {
namespace {

std::vector<std::byte> bytes_of(std::initializer_list<int> values, std::size_t size = 0) {
  std::vector<std::byte> bytes;
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
  if (size > 0) bytes.resize(size);
  return bytes;
}

std::vector<std::byte> written(WoodenProtocol protocol, const BoardCommand& order) {
  std::array<std::byte, kReportMax> buffer;
  buffer.fill(std::byte{0xEE});
  const std::size_t n = write_command(protocol, order, buffer);
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(n)};
}

TEST(BoardReport, MatchesHandComputedValues) {
  // 1, -1, 0x1234, then the gimbal's 256, -32768, 32767, and the latched button.
  const auto v2 = bytes_of({1, 0, 0xFF, 0xFF, 0x34, 0x12, 0, 1, 0, 0x80, 0xFF, 0x7F, 1, 0});
  const BoardReport expected{{1, -1, 0x1234, 256, -32768, 32767}, true, false};
  EXPECT_EQ(parse_report(WoodenProtocol::kV2, false, v2), expected);
  auto raw = v2;
  raw.resize(64, std::byte{0xAA});  // padding is ignored
  EXPECT_EQ(parse_report(WoodenProtocol::kRaw64, false, raw), expected);
  const auto v1 = bytes_of({0xD0, 0x07, 0, 0, 0x30, 0xF8, 7, 0});
  EXPECT_EQ(parse_report(WoodenProtocol::kV1, false, v1), (BoardReport{{2000, 0, -2000, 0, 0, 0}, false, false}));
}

TEST(BoardReport, ReportsAButtonOnlyForInfoOne) {
  for (const int info : {0, 2, 3, 255}) {
    const auto v2 = bytes_of({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, info, 0});
    EXPECT_FALSE(parse_report(WoodenProtocol::kV2, false, v2)->calibration_pressed) << info;
  }
}

TEST(BoardReport, ReadsTheStylusButtonFromEncoderD) {
  const auto held = bytes_of({0, 0, 0, 0, 0, 0, 0x74, 0x27, 0, 0, 0, 0, 0, 0});  // 10100
  EXPECT_EQ(parse_report(WoodenProtocol::kV2, true, held), (BoardReport{{0, 0, 0, 100, 0, 0}, false, true}));
  EXPECT_EQ(parse_report(WoodenProtocol::kV2, false, held), (BoardReport{{0, 0, 0, 10100, 0, 0}, false, false}));
  const auto edge = bytes_of({0, 0, 0, 0, 0, 0, 0x88, 0x13, 0, 0, 0, 0, 0, 0});  // 5000: not above half
  EXPECT_FALSE(parse_report(WoodenProtocol::kV2, true, edge)->stylus_pressed);
}

TEST(BoardReport, EncodesCommandsAsComputedByHand) {
  const BoardCommand currents{.current_ma = {1000, -1000, 300}};
  EXPECT_EQ(written(WoodenProtocol::kV1, currents), bytes_of({0xE8, 3, 0x18, 0xFC, 0x2C, 1, 0, 0}));
  EXPECT_EQ(written(WoodenProtocol::kV2, currents), bytes_of({0xE8, 3, 0x18, 0xFC, 0x2C, 1}, 14));
  EXPECT_EQ(written(WoodenProtocol::kRaw64, currents), bytes_of({0xE8, 3, 0x18, 0xFC, 0x2C, 1}, 64));
}

TEST(BoardReport, DrivesNoMotorInAPresetCommand) {
  const BoardCommand preset{.current_ma = {2000, 2000, 2000}, .preset = true, .counts = {0, -1, 6000, 4, 5, 6}};
  EXPECT_EQ(written(WoodenProtocol::kV2, preset), bytes_of({4, 0, 5, 0, 6, 0, 1, 0, 0, 0, 0xFF, 0xFF, 0x70, 0x17}));
  EXPECT_EQ(written(WoodenProtocol::kV1, preset), bytes_of({}, 8)) << "a v1 board would take it for currents";
}

TEST(BoardReport, RejectsEveryOtherLength) {
  const std::vector<std::byte> bytes(100, std::byte{0});
  for (std::size_t n = 0; n <= 100; ++n) {
    for (const auto protocol : {WoodenProtocol::kV1, WoodenProtocol::kV2, WoodenProtocol::kRaw64}) {
      EXPECT_EQ(parse_report(protocol, true, std::span(bytes).first(n)).has_value(), n == report_size(protocol)) << n;
    }
  }
}

TEST(BoardReport, DecodesOrRejectsAnyBytes) {
  const std::size_t n = test::draws(300'000, 10'000'000, 30'000'000);
  std::printf("[ reports  ] %zu\n", n);
  RandomStream r(1);
  std::array<std::byte, 80> bytes;
  std::size_t read = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < bytes.size(); k += 8) {
      const std::uint64_t word = r.bits();
      for (std::size_t b = 0; b < 8; ++b) bytes[k + b] = static_cast<std::byte>(word >> (8 * b));
    }
    const auto protocol = static_cast<WoodenProtocol>(r.below(3));
    const std::size_t size = r.below(2) == 0 ? report_size(protocol) : r.below(81);
    const auto report = parse_report(protocol, r.below(2) == 0, std::span(bytes).first(size));
    ASSERT_EQ(report.has_value(), size == report_size(protocol));
    if (!report) continue;
    ++read;
    ASSERT_LE(report->counts[3], report->stylus_pressed ? 22767 : 32767);
  }
  EXPECT_GT(read, n / 3);
}

TEST(UnwrappedCounter, ContinuesPastTheWrapInBothDirections) {
  UnwrappedCounter c;
  c.set(27140, 27140);
  std::int16_t board = 27140;
  for (int i = 0; i < 100; ++i) {
    board = static_cast<std::int16_t>(static_cast<std::uint16_t>(board) + 997);
    EXPECT_EQ(c.take(board), 997);
  }
  EXPECT_EQ(c.total(), 27140 + 99700);
  for (int i = 0; i < 300; ++i) {
    board = static_cast<std::int16_t>(static_cast<std::uint16_t>(board) - 1003u);
    EXPECT_EQ(c.take(board), -1003);
  }
  EXPECT_EQ(c.total(), 27140 + 99700 - 300900);
  EXPECT_EQ(UnwrappedCounter::difference(-32768, 32767), 1);
  EXPECT_EQ(UnwrappedCounter::difference(32767, -32768), -1);
  EXPECT_EQ(UnwrappedCounter::difference(0, -32768), -32768);
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
