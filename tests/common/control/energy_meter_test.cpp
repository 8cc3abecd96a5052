#include "common/control/energy_meter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace tandem::control {
namespace {

TEST(EnergyMeter, MeasuresTheEnergyThatASampledSpringCreates) {  // 1000 N/m, 10 mm, 5 Hz, 1 kHz: 4.9 mJ a cycle
  EnergyMeter meter;
  AxisArray q{}, held{};
  double wrong = 0, q_old = 0;
  for (int k = 0; k <= 2000; ++k) {  // ten cycles
    q[0] = 0.01 * std::sin(2 * std::numbers::pi * 5 * k * 0.001);
    meter.advance(1, q, held);
    held[0] = -1000 * q[0];
    wrong += held[0] * (q[0] - q_old);  // wrong pairing: new effort times past motion
    q_old = q[0];
  }
  EXPECT_NEAR(meter.total() / 10, 4.9e-3, 0.05e-3);
  EXPECT_NEAR(wrong / 10, -4.9e-3, 0.05e-3);
}

TEST(EnergyMeter, CountsNothingAtItsFirstSample) {
  EnergyMeter meter;
  EXPECT_EQ(meter.advance(3, {1, 2, 3}, {5, 5, 5}), 0);
  EXPECT_NEAR(meter.advance(3, {1.1, 2, 2.9}, {5, 7, 2}), 0.5 - 0.2, 1e-12);
  EXPECT_NEAR(meter.total(), 0.3, 1e-12);
}

TEST(EnergyMeter, SkipsANonFiniteReadingButNotTheMotion) {
  EnergyMeter meter;
  meter.advance(1, {0}, {0});
  EXPECT_EQ(meter.advance(1, {std::numeric_limits<double>::quiet_NaN()}, {2}), 0);
  EXPECT_NEAR(meter.advance(1, {0.1}, {2}), 0.2, 1e-12);
  EXPECT_NEAR(meter.total(), 0.2, 1e-12);
}

TEST(EnergyMeter, StartsAtTheFirstFiniteReading) {
  EnergyMeter meter;
  EXPECT_EQ(meter.advance(2, {0, std::numeric_limits<double>::quiet_NaN()}, {2, 2}), 0);
  EXPECT_EQ(meter.advance(2, {std::numeric_limits<double>::infinity(), 0}, {2, 2}), 0);
  EXPECT_EQ(meter.advance(2, {0.1, 0.3}, {2, 2}), 0);
  EXPECT_NEAR(meter.advance(2, {0.2, 0.3}, {2, 2}), 0.2, 1e-12);
  EXPECT_NEAR(meter.total(), 0.2, 1e-12);
}

}  // namespace
}  // namespace tandem::control
