// Driver and device model of the Falcon, each compared separately with the results of an independent host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/hal/drivers/falcon/falcon_fixture.h"
#include "tests/hal/drivers/falcon/golden_vectors.h"
#include "tests/hal/emulation/devices/falcon_mechanics.h"

namespace tandem::hal::falcon {
namespace {

using namespace std::chrono_literals;

/// Converts a point from libnifalcon's frame to the HAL's frame.
/// libnifalcon: x right, y up, z to the user, from its base. HAL: x right, y away, z up, 117.5 mm before the base.
Vec3 point_in_hal(const Eigen::Vector3d& p) { return {p[0], 0.1175 - p[2], p[1]}; }
Vec3 force_in_hal(const Eigen::Vector3d& f) { return {f[0], -f[2], f[1]}; }

std::array<Vec3, 4> golden_forces() {
  return {force_in_hal({1, 0, 0}), force_in_hal({0, 1, 0}), force_in_hal({0, 0, 1}),
          force_in_hal(test::kGoldenFalconMixed)};
}

/// A homed Falcon reduced to three counters and a memory, behind its FTDI bridge.
/// Bytes are composed here independently: 12 nibbles, least significant first, + 'A', between '<' and '>'.
struct BareFalcon final : UsbPipe, Clock {
  std::expected<void, Errc> control(std::uint8_t, std::uint16_t, std::uint16_t) noexcept override { return {}; }
  std::expected<void, Errc> clear_halt() noexcept override { return {}; }
  Moved write(std::span<const std::byte> bytes, Duration) noexcept override {
    if (bytes.size() == 16 && bytes[0] == std::byte{'<'}) {
      for (std::size_t i = 0; i < 3; ++i) {
        unsigned value = 0;
        for (std::size_t n = 0; n < 4; ++n)
          value |= (std::to_integer<unsigned>(bytes[1 + 4 * i + n]) - 0x41U) << (4 * n);
        motors[i] = static_cast<std::int16_t>(value);
      }
      waits = true;
    }
    return bytes.size();
  }
  Moved read(std::span<std::byte> into, Duration timeout) noexcept override {
    into[0] = std::byte{0x01};
    into[1] = std::byte{0x60};
    if (!std::exchange(waits, false)) {
      at += timeout;
      return std::size_t{2};
    }
    into[2] = std::byte{'<'};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = static_cast<unsigned>(counts[i]) & 0xffffU;
      for (std::size_t n = 0; n < 4; ++n)
        into[3 + 4 * i + n] = static_cast<std::byte>(0x41U + (value >> (4 * n) & 0xfU));
    }
    into[15] = std::byte{0x41 + 0x70};  // all three legs are homed, no button
    into[16] = std::byte{0x41};
    into[17] = std::byte{'>'};
    return std::size_t{18};
  }
  Time now() noexcept override { return at; }
  void wait_until(Time until) noexcept override { at = std::max(at, until); }

  bool waits = false;
  std::array<int, 3> counts{};
  std::array<std::int16_t, 3> motors{};
  Time at = Time{} + 1h;
};

TEST(FalconGolden, MatchesLibnifalconInPoseAndMotorCommands) {
  BareFalcon falcon;
  auto driver = FalconDriver::make({"falcon", "1-2"}, falcon, falcon, {calibrated(10000), std::nullopt});
  ASSERT_TRUE(driver);
  Watcher watcher;
  ASSERT_TRUE(driver->bring_up(watcher));
  State state;
  const auto step = [&](const Vec3& effort) {
    falcon.at += 1ms;
    ASSERT_TRUE(driver->exchange({.seq = 1, .effort = {effort[0], effort[1], effort[2]}}, state));
  };
  for (const test::GoldenLegs& legs : test::kGoldenFalcon) {
    SCOPED_TRACE(std::to_string(legs.counts[0]) + " " + std::to_string(legs.counts[1]) + " " +
                 std::to_string(legs.counts[2]));
    falcon.counts = legs.counts;
    for (int i = 0; i < 3; ++i) step(Vec3::Zero());
    ASSERT_TRUE(state.homed);
    EXPECT_LT((state.x - point_in_hal(legs.tip)).norm(), 2e-6) << state.x.transpose();
    for (std::size_t f = 0; f < 4; ++f) {
      step(state.J.leftCols<3>().transpose() * golden_forces()[f]);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(falcon.motors[i], legs.motors[f][static_cast<int>(i)], 1.0) << "force " << f << ", motor " << i;
    }
  }
}

TEST(FalconGolden, MatchesLibnifalconInTheEmulatedDevice) {
  for (const test::GoldenLegs& legs : test::kGoldenFalcon) {
    SCOPED_TRACE(std::to_string(legs.counts[0]) + " " + std::to_string(legs.counts[1]) + " " +
                 std::to_string(legs.counts[2]));
    emulation::FalconMechanics mechanics({.counts_per_nm = {10000, 10000, 10000}, .start = point_in_hal(legs.tip)});
    for (std::size_t i = 0; i < 3; ++i) mechanics.find_origin(i);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(mechanics.encoder()[i], legs.counts[i], 1) << "leg " << i;
    for (std::size_t f = 0; f < 4; ++f) {
      std::array<std::int16_t, 3> motors{};
      for (std::size_t i = 0; i < 3; ++i)
        motors[i] = static_cast<std::int16_t>(std::lround(legs.motors[f][static_cast<int>(i)]));
      emulation::FalconMechanics pushed = mechanics;
      pushed.advance(motors, 1e-6);
      EXPECT_LT((pushed.motor_force() - golden_forces()[f]).norm(), 0.01)
          << "force " << f << ": " << pushed.motor_force().transpose();
    }
  }
}

}  // namespace
}  // namespace tandem::hal::falcon
