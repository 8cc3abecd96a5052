#include "hal/drivers/woodenhaptics/motors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/hal/drivers/woodenhaptics/mechanisms.h"

namespace tandem::hal::woodenhaptics {
namespace {

using Currents = std::array<std::int16_t, 3>;

TEST(WoodenMotors, MatchHandComputedCurrents) {
  const Motors m(test::wooden_2015());
  // One ampere: 0.0259 N m at the motor, 16 or 12 times that at the drum.
  const MotorCommand order = m.to_command({0.0259 * 16, -0.0259 * 12, 0.0259 * 6}, Vec3::Zero());
  EXPECT_EQ(order.current_ma, (Currents{1000, -1000, 500}));
  EXPECT_FALSE(order.saturated);
  EXPECT_NEAR(order.effort[0], 0.4144, 1e-12);
  EXPECT_NEAR(order.effort[2], 0.1554, 1e-12);
}

TEST(WoodenMotors, DirectionAndFullScalesAreThePresets) {
  WoodenHapticsSpec spec = test::wooden_2015();
  spec.motor_direction = {-1, 1, 1};
  spec.amplifier_full_scale = 6;  // of a firmware that assumes 3: half the number produces the current
  const Motors m(spec);
  const MotorCommand order = m.to_command({0.0259 * 16, 0.0259 * 12, 0}, Vec3::Zero());
  EXPECT_EQ(order.current_ma, (Currents{-500, 500, 0}));
  EXPECT_EQ(m.limit_ma(), 1000) << "2 A";
  spec.amplifier_full_scale = 1;  // two amperes would need more than full PWM
  EXPECT_EQ(Motors(spec).limit_ma(), 3000);
  EXPECT_NEAR(Motors(spec).effort_of({3000, 3000, 0})[1], 0.0259 * 12, 1e-12);
}

TEST(WoodenMotors, ClampKeepsTheDirection) {
  const Motors m(test::wooden_2015());
  const Vec3 wanted(0.0259 * 16 * 4, -0.0259 * 12 * 2, 0.0259 * 12);
  const MotorCommand order = m.to_command(wanted, Vec3::Zero());
  EXPECT_EQ(order.current_ma, (Currents{2000, -1000, 500}));
  EXPECT_TRUE(order.saturated);
  EXPECT_LT((order.effort - 0.5 * wanted).norm(), 1e-12);
}

TEST(WoodenMotors, ReserveGravityCompensationBeforeEffort) {
  const Motors m(test::wooden_2015());
  const Vec3 carry(0.0, 0.0259 * 12 * 1.5, 0.0);  // 1.5 A of 2 A
  const MotorCommand order = m.to_command({0.0, 0.0259 * 12, 0.0}, carry);
  EXPECT_EQ(order.current_ma, (Currents{0, 2000, 0}));
  EXPECT_NEAR(order.effort[1], 0.5 * 0.0259 * 12, 1e-12) << "only what was left";
  EXPECT_TRUE(order.saturated);
  const MotorCommand against = m.to_command({0.0, -0.0259 * 12 * 3, 0.0}, carry);
  EXPECT_EQ(against.current_ma, (Currents{0, -1500, 0})) << "the other way there is more room";
  EXPECT_FALSE(against.saturated);
}

TEST(WoodenMotors, KeepAnyEffortInTheClampAndReportTheGivenEffort) {
  const std::uint64_t seeds = test::seeds(20'000);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    RandomStream r(seed);
    WoodenHapticsSpec spec = test::wooden_2015();
    spec.current_max = r.uniform(0.01, 6);
    spec.amplifier_full_scale = r.uniform(1, 6);
    for (auto& d : spec.motor_direction) d = r.below(2) == 0 ? 1 : -1;
    const Motors m(spec);
    const auto effort = [&]() -> Vec3 {
      return std::exp(r.uniform(-20, 20)) * Vec3(r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1));
    };
    const Vec3 asked = effort(), carry = r.below(2) == 0 ? Vec3(Vec3::Zero()) : effort();
    const MotorCommand order = m.to_command(asked, carry);
    for (int i = 0; i < 3; ++i) {
      const int ma = order.current_ma[static_cast<std::size_t>(i)];
      ASSERT_LE(std::abs(ma), m.limit_ma()) << seed;
      const double real = ma / 1000.0 * spec.amplifier_full_scale / spec.firmware_full_scale;
      ASSERT_LE(std::abs(real), spec.current_max + 1e-9) << seed;
      // Never more than commanded, except for half a milliampere of rounding.
      const double quantum =
          0.0011 * spec.amplifier_full_scale / spec.firmware_full_scale / std::abs(m.current_per_effort()[i]);
      ASSERT_LE(std::abs(order.effort[i]), std::abs(asked[i]) + quantum) << seed;
      ASSERT_GE(order.effort[i] * asked[i], -quantum * std::abs(asked[i])) << seed;
    }
  }
}

TEST(WoodenMotors, GiveZeroForNonFiniteEffort) {
  const Motors m(test::wooden_2015());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(m.to_command({bad, 0.1, 0.1}, Vec3::Zero()).current_ma, (Currents{0, 0, 0}));
    EXPECT_TRUE(m.to_command({bad, 0.1, 0.1}, Vec3::Zero()).saturated);
    EXPECT_EQ(m.to_command(Vec3::Zero(), {bad, 0, 0}).current_ma, (Currents{0, 0, 0}));
  }
  EXPECT_EQ(m.to_command(1e308 * Vec3::Ones(), Vec3::Zero()).current_ma, (Currents{0, 0, 0})) << "no finite current";
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
