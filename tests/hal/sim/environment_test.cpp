#include "hal/sim/environment.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tandem::hal::sim {
namespace {

EnvironmentSpec wall(double k, bool from_below = true) {
  EnvironmentSpec e;
  e.wall = WallSpec{0, 0.01, k, 5.0, from_below};
  return e;
}

TEST(Environment, MeasuresPenetrationFromTheRightSide) {
  EXPECT_NEAR(Environment(wall(1e4)).penetration({0.012, 0, 0}), 0.002, 1e-15);
  EXPECT_EQ(Environment(wall(1e4)).penetration({0.008, 0, 0}), 0.0);
  EXPECT_NEAR(Environment(wall(1e4, false)).penetration({0.008, 0, 0}), 0.002, 1e-15);
}

TEST(Environment, TissueStiffens) {
  EnvironmentSpec e;
  e.tissue = TissueSpec{};
  const Environment tissue(e);
  ASSERT_EQ(tissue.size(), 1u);
  EXPECT_NEAR(tissue[0].spring(0.01), 300 * 0.01 + 1e6 * 1e-6, 1e-12);
  EXPECT_NEAR(tissue[0].slope(0.01), 300 + 3e6 * 1e-4, 1e-9);
}

TEST(ContactStep, NeverPullsForAnyStiffnessOrSpeed) {
  for (double k = 1e-3; k < 2e9; k *= 10) {
    const Surface s{0, -1.0, 0.0, k, 0.0, 5.0};
    for (const double d : {-1e-4, -1e-9, 0.0, 1e-9, 1e-6, 1e-3}) {
      for (const double rate : {-1.0, -1e-3, 0.0, 1e-3, 1.0}) {
        const ContactStep c(s, d, rate, 0.0, 20.0, 0.25e-3);
        const double f = c.force(0.0, 20.0, 0.25e-3);
        EXPECT_TRUE(std::isfinite(f));
        EXPECT_GE(f, 0.0);
      }
    }
  }
}

TEST(ContactStep, EqualsTheSpringAtRest) {
  const Surface s{0, -1.0, 0.0, 2e4, 0.0, 5.0};
  const ContactStep c(s, 1e-4, 0.0, 0.0, 20.0, 0.25e-3);
  // The other forces equal the spring's force: nothing moves.
  EXPECT_NEAR(c.force(0.25e-3 * 20.0 * 2.0, 20.0, 0.25e-3), 2.0, 1e-12);
}

}  // namespace
}  // namespace tandem::hal::sim
