// Efforts between two readings, and the share of gravity that the motors compensate.
#include <gtest/gtest.h>

#include "hal/drivers/woodenhaptics/gravity_fade.h"
#include "hal/drivers/woodenhaptics/mean_effort.h"

namespace tandem::hal::woodenhaptics {
namespace {

using namespace std::chrono_literals;

TEST(MeanEffort, WeightsEachEffortByItsDuration) {
  MeanEffort mean;
  mean.restart(Time{1s});
  mean.add({1, 0, 0}, Time{1s + 1ms});
  mean.add({4, 0, 0}, Time{1s + 3ms});
  EXPECT_DOUBLE_EQ(mean.take({9, 0, 0})[0], 3);
  EXPECT_DOUBLE_EQ(mean.take({9, 0, 0})[0], 9) << "no time has passed since";
  mean.add({2, 0, 0}, Time{1s + 4ms});
  mean.add({7, 0, 0}, Time{1s});  // a clock that goes back adds nothing
  EXPECT_DOUBLE_EQ(mean.take({})[0], 2);
}

TEST(GravityFade, FadesInWithinHalfASecondOfCommandsWithEffort) {
  GravityFade gravity;
  Time now{1s};
  EXPECT_EQ(gravity.update(now, false, 1ms), 0);
  for (int k = 0; k < 250; ++k) gravity.update(now += 1ms, true, 1ms);
  EXPECT_NEAR(gravity.update(now, true, 0ms), 0.5, 1e-9);
  for (int k = 0; k < 300; ++k) gravity.update(now += 1ms, true, 1ms);
  EXPECT_EQ(gravity.update(now, true, 0ms), 1);
}

TEST(GravityFade, FadesOut100MsAfterTheLastEffort) {
  GravityFade gravity;
  Time now{1s};
  for (int k = 0; k < 600; ++k) gravity.update(now += 1ms, true, 1ms);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(gravity.update(now += 1ms, false, 1ms), 1);
  for (int k = 0; k < 50; ++k) gravity.update(now += 1ms, false, 1ms);
  EXPECT_NEAR(gravity.update(now, false, 0ms), 0.5, 1e-9);
}

TEST(GravityFade, LimitsTheStepAfterAPauseAndStartsAtZeroAfterARelease) {
  GravityFade gravity;
  EXPECT_DOUBLE_EQ(gravity.update(Time{1s}, true, 1s), 0.02) << "10 ms at most";
  gravity.release();
  EXPECT_EQ(gravity.update(Time{1s}, false, 0ms), 0);
  EXPECT_GT(gravity.update(Time{1s}, false, 1ms), 0) << "the last effort is recent";
  gravity.restart();
  EXPECT_EQ(gravity.update(Time{1s}, false, 1ms), 0);
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
