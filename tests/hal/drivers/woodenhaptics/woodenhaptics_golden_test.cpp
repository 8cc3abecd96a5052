// The shipped presets, the driver and the device model, each compared separately with the results of independent hosts.
// An error common to driver and model is detected here.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "hal/drivers/woodenhaptics/woodenhaptics_driver.h"
#include "proto/text/device_text.h"
#include "proto/text/presets_embedded.h"
#include "tests/hal/drivers/woodenhaptics/golden_vectors.h"
#include "tests/hal/emulation/devices/hid_model_pipe.h"
#include "tests/hal/emulation/devices/woodenhaptics_model.h"

namespace tandem::hal::woodenhaptics {
namespace {

using namespace std::chrono_literals;
using Counts = std::array<int, 3>;

constexpr double kTipTolerance = 2e-6;  ///< [m]; WE writes pi/2 as 3.141592/2
constexpr double kMilliampere = 1e-3;

struct Golden {
  const char* preset;
  std::span<const test::GoldenArm> arms;
};

std::array<Golden, 4> all_golden() {
  return {{{"woodenhaptics-2015", test::kGolden2015},
           {"woodenhaptics-2019", test::kGolden2019},
           {"aluhaptics-v2", test::kGoldenAluhaptics},
           {"polhem-v1", test::kGoldenPolhem1}}};
}

/// Converts a vector from the hosts' frame (x to the user, y right, z up) to the HAL's (x right, y away, z up).
Vec3 in_hal(const Eigen::Vector3d& v) { return {v[1], -v[0], v[2]}; }

std::array<Vec3, 4> golden_forces() {
  return {in_hal({1, 0, 0}), in_hal({0, 1, 0}), in_hal({0, 0, 1}), in_hal(test::kGoldenMixed)};
}

WoodenHapticsSpec shipped(const char* name) {
  const auto file = parse_device_text(find_shipped_preset(name)->text, name);
  EXPECT_TRUE(file && file->woodenhaptics) << name;
  return *file->woodenhaptics;
}

std::int16_t word(std::span<const std::byte> bytes, std::size_t i) {
  return static_cast<std::int16_t>(std::to_integer<int>(bytes[2 * i]) + 256 * std::to_integer<int>(bytes[2 * i + 1]));
}

void put(std::span<std::byte> bytes, std::size_t i, int value) {
  const auto u = static_cast<unsigned>(value) & 0xffffU;
  bytes[2 * i] = static_cast<std::byte>(u % 256);
  bytes[2 * i + 1] = static_cast<std::byte>(u / 256);
}

/// A board reduced to counters and a memory: no mechanism, no signs. Only waiting advances its time.
struct BareBoard final : HidPipe, Clock {
  explicit BareBoard(WoodenProtocol protocol) : v1(protocol == WoodenProtocol::kV1) {}

  Moved write(std::span<const std::byte> report) noexcept override {
    if (!v1 && word(report, 3) == 1) {
      for (std::size_t i = 0; i < 3; ++i) counts[i] = word(report, 4 + i);
    } else {
      for (std::size_t i = 0; i < 3; ++i) milliamperes[i] = word(report, i);
    }
    waits = true;
    return report.size();
  }
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    if (!std::exchange(waits, false)) {
      at += timeout;
      return std::size_t{0};
    }
    const std::size_t size = v1 ? 8 : 14;
    std::ranges::fill(into.first(size), std::byte{0});
    for (std::size_t i = 0; i < 3; ++i) put(into, i, counts[i]);
    return size;
  }
  Time now() noexcept override { return at; }
  void wait_until(Time until) noexcept override { at = std::max(at, until); }

  bool v1, waits = false;
  Counts counts{}, milliamperes{};
  Time at = Time{} + 1h;
};

/// The driver of a shipped preset on such a board, homed.
struct Host {
  explicit Host(const WoodenHapticsSpec& spec)
      : board(spec.protocol),
        driver({"woodenhaptics", "0001"}, board, board, {.spec = spec, .enable_motors = true, .home_at_start = true}) {
    test::QuietBringUp quiet;
    EXPECT_TRUE(driver.bring_up(quiet));
    for (int i = 0; i < 5; ++i) step();
    EXPECT_TRUE(state.homed);
  }
  void step(const Vec3& effort = Vec3::Zero()) {
    board.at += 1ms;
    EXPECT_TRUE(driver.exchange({.seq = 1, .effort = {effort[0], effort[1], effort[2]}}, state));
  }
  /// Turns the board's counters to `to`, slowly enough that the driver does not detect a lost reference.
  void turn_to(const Counts& to) {
    const Counts from = board.counts;
    constexpr int kSteps = 40;
    for (int s = 1; s <= kSteps; ++s) {
      for (std::size_t i = 0; i < 3; ++i) board.counts[i] = from[i] + (to[i] - from[i]) * s / kSteps;
      step();
    }
  }
  BareBoard board;
  WoodenHapticsDriver driver;
  State state;
};

TEST(WoodenGolden, MatchesThePoseOfIndependentHosts) {
  for (const Golden& golden : all_golden()) {
    Host host(shipped(golden.preset));
    for (const test::GoldenArm& arm : golden.arms) {
      SCOPED_TRACE(std::string(golden.preset) + " " + std::to_string(arm.counts[0]) + " " +
                   std::to_string(arm.counts[1]) + " " + std::to_string(arm.counts[2]));
      host.turn_to(arm.counts);
      ASSERT_TRUE(host.state.homed);
      EXPECT_LT((host.state.x - in_hal(arm.tip)).norm(), kTipTolerance) << host.state.x.transpose();
    }
  }
}

TEST(WoodenGolden, MatchesTheCurrentsOfIndependentHosts) {
  for (const Golden& golden : all_golden()) {
    const WoodenHapticsSpec spec = shipped(golden.preset);
    Host host(spec);
    for (const test::GoldenArm& arm : golden.arms) {
      host.turn_to(arm.counts);
      for (std::size_t f = 0; f < 4; ++f) {
        SCOPED_TRACE(std::string(golden.preset) + ", force " + std::to_string(f));
        host.step(host.state.J.leftCols<3>().transpose() * golden_forces()[f]);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(host.board.milliamperes[i] * kMilliampere, arm.amperes[f][static_cast<int>(i)],
                      0.6 * kMilliampere)
              << "motor " << i;
        }
        host.step();
      }
    }
  }
}

/// The device model alone, accessed by bytes.
struct Bare {
  explicit Bare(const WoodenHapticsSpec& spec, const Vec3& start) : model({.spec = spec, .start = start}) {
    model.place(start);
  }
  Counts ask(const Counts& milliamperes, std::optional<Counts> preset = {}) {
    std::array<std::byte, 64> bytes{};
    for (std::size_t i = 0; i < 3; ++i) put(bytes, i, preset ? 0 : milliamperes[i]);
    if (preset) {
      put(bytes, 3, 1);
      for (std::size_t i = 0; i < 3; ++i) put(bytes, 4 + i, (*preset)[i]);
    }
    const std::size_t size = model.product_id() == 0x0486 ? 64 : v1 ? 8 : 14;
    EXPECT_TRUE(model.report_out(std::span(bytes).first(size)));
    model.advance(2ms);
    Counts counts{};
    while (const auto got = model.report_in(bytes)) {
      for (std::size_t i = 0; i < 3; ++i) counts[i] = word(bytes, i);
    }
    return counts;
  }
  emulation::WoodenHapticsModel model;
  bool v1 = false;
};

TEST(WoodenGolden, MatchesIndependentHostsInTheEmulatedBoard) {
  for (const Golden& golden : all_golden()) {
    const WoodenHapticsSpec spec = shipped(golden.preset);
    const test::GoldenArm& first = golden.arms.front();
    Bare board(spec, in_hal(first.tip));
    board.v1 = spec.protocol == WoodenProtocol::kV1;
    (void)board.ask({}, board.v1 ? std::nullopt : std::optional(first.counts));
    for (const test::GoldenArm& arm : golden.arms) {
      SCOPED_TRACE(std::string(golden.preset) + " " + std::to_string(arm.counts[0]));
      ASSERT_TRUE(board.model.place(in_hal(arm.tip)));
      const Counts counts = board.ask({});
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(counts[i], arm.counts[i], 1) << "encoder " << i;
      for (std::size_t f = 0; f < 4; ++f) {
        Counts milliamperes{};
        for (std::size_t i = 0; i < 3; ++i)
          milliamperes[i] = static_cast<int>(std::lround(1000 * arm.amperes[f][static_cast<int>(i)]));
        (void)board.ask(milliamperes);
        EXPECT_LT((board.model.motor_force() - golden_forces()[f]).norm(), 0.02)
            << "force " << f << ": " << board.model.motor_force().transpose();
      }
      (void)board.ask({});
    }
  }
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
