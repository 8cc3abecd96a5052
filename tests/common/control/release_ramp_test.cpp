#include "common/control/release_ramp.h"

#include <gtest/gtest.h>

#include "common/control/loss_latch.h"

namespace tandem::control {
namespace {

using namespace std::chrono_literals;

TEST(ReleaseRamp, FallsToZeroWithin100Milliseconds) {
  ReleaseRamp ramp;
  ramp.begin(Time{} + 1s, {2, -3});
  EXPECT_EQ(ramp.from(0), 2);
  EXPECT_EQ(ramp.from(1), -3);
  EXPECT_EQ(ramp.left(Time{} + 1s), 1);
  EXPECT_NEAR(ramp.left(Time{} + 1s + 25ms), 0.75, 1e-12);
  EXPECT_EQ(ramp.left(Time{} + 1s + 100ms), 0);
  EXPECT_EQ(ramp.left(Time{} + 9s), 0);
}

TEST(LossLatch, LatchesTheThirdLossWithinTenSeconds) {
  LossLatch losses;
  EXPECT_FALSE(losses.record(Time{} + 1s));
  EXPECT_FALSE(losses.record(Time{} + 2s));
  EXPECT_TRUE(losses.record(Time{} + 11s));
  EXPECT_FALSE(losses.record(Time{} + 13s)) << "the second loss was 11 s before";
  EXPECT_EQ(losses.trips(), 4u);
}

}  // namespace
}  // namespace tandem::control
