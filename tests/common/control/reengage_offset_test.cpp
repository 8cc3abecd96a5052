#include "common/control/reengage_offset.h"

#include <gtest/gtest.h>

namespace tandem::control {
namespace {

ReengageOffset offset_of(double metres) {
  ReengageOffset offset({.axes = 1, .hold = 0.5, .v_app = 0.1, .dt = 0.001});
  offset.set(0, metres);
  return offset;
}

TEST(ReengageOffset, StaysUntilTheGateHasRampedIn) {
  const ReengageOffset offset = offset_of(0.02);
  EXPECT_TRUE(offset.stays(0.499));
  EXPECT_FALSE(offset.stays(0.5));
  EXPECT_EQ(offset.decay(0, offset.pace(0.5)), 0);
}

TEST(ReengageOffset, DecaysAtTheApproachSpeedAfterARampOfThreeTenthsOfASecond) {
  const ReengageOffset offset = offset_of(0.02), other = offset_of(-0.02);
  EXPECT_NEAR(offset.decay(0, offset.pace(0.65)), -0.5 * 0.1 * 0.001, 1e-18);
  EXPECT_NEAR(offset.decay(0, offset.pace(0.8)), -0.1 * 0.001, 1e-18);
  EXPECT_NEAR(other.decay(0, other.pace(9)), 0.1 * 0.001, 1e-18);
}

TEST(ReengageOffset, EndsAtZero) {
  ReengageOffset offset = offset_of(0.00015);
  offset.move(0, offset.decay(0, 1));
  EXPECT_NEAR(offset[0], 0.00005, 1e-18);
  EXPECT_NEAR(offset.last_step()[0], -0.0001, 1e-18);
  offset.move(0, offset.decay(0, 1));
  EXPECT_EQ(offset[0], 0);
  EXPECT_EQ(offset.decay(0, 1), 0);
  offset.set(0, 0.01);
  EXPECT_EQ(offset.last_step()[0], 0) << "a set offset is no step";
}

TEST(ReengageOffset, ScalesItsSpeedToTheAxis) {
  ReengageOffset::Params p{.axes = 1};
  p.root_scale[0] = 0.2;
  ReengageOffset offset(p);
  offset.set(0, 1);
  EXPECT_NEAR(offset.decay(0, 1), -0.1 / 0.2 * 0.001, 1e-18);
}

TEST(ReengageOffset, AbsorbsAnElongationBeyondItsReach) {
  ReengageOffset offset({.axes = 2});
  offset.absorb({0.0015, 0.002}, 0.005);
  EXPECT_EQ(offset[0], 0) << "within the reach nothing is absorbed";
  offset.absorb({0.006, 0.008}, 0.005);
  EXPECT_NEAR(offset[0], -0.003, 1e-15) << "half of 10 mm";
  EXPECT_NEAR(offset[1], -0.004, 1e-15);
}

}  // namespace
}  // namespace tandem::control
