// Detects a hand that is too fast, from synthetic samples 1 ms apart.
#include "common/control/overspeed_guard.h"

#include <gtest/gtest.h>

#include <limits>

namespace tandem::control {
namespace {

using namespace std::chrono_literals;

struct Drive {
  void look(double speed, int samples = 1, bool active = true) {
    for (int i = 0; i < samples; ++i) guard.update(now += 1ms, speed, active);
  }
  OverspeedGuard guard;
  Time now{1s};
};

TEST(OverspeedGuard, TripsAtTheThirdConsecutiveSample) {
  Drive d;
  for (int n = 0; n < 100; ++n) {
    d.look(1.51, 2);
    d.look(1.5);  // the limit itself is allowed
  }
  EXPECT_FALSE(d.guard.inhibits());
  d.look(1.51, 2);
  EXPECT_FALSE(d.guard.inhibits());
  d.look(1.51);
  EXPECT_TRUE(d.guard.inhibits());
  EXPECT_EQ(d.guard.trips(), 1u);
}

TEST(OverspeedGuard, InhibitsUntilTheHandWasSlowFor200Milliseconds) {
  Drive d;
  d.look(2, 3);
  d.look(0.1, 199, false);
  EXPECT_TRUE(d.guard.inhibits());
  d.look(1.6, 1, false);  // the hand moves again: the wait restarts
  d.look(0.1, 199, false);
  EXPECT_TRUE(d.guard.inhibits());
  d.look(0.1, 1, false);
  EXPECT_FALSE(d.guard.inhibits());
}

TEST(OverspeedGuard, LatchesAtTheThirdTripUntilTheButton) {
  Drive d;
  for (int n = 0; n < 3; ++n) {
    EXPECT_FALSE(d.guard.inhibits()) << n;
    d.look(2, 3);
    EXPECT_TRUE(d.guard.inhibits());
    d.look(0, 1000, false);
  }
  EXPECT_TRUE(d.guard.inhibits());
  EXPECT_TRUE(d.guard.latched());
  d.guard.reset();
  EXPECT_FALSE(d.guard.inhibits());
  EXPECT_FALSE(d.guard.latched());
}

TEST(OverspeedGuard, TreatsNanAsTooFastAndAllowsSpeedWithoutForce) {
  Drive d;
  d.look(10, 100, false);
  EXPECT_EQ(d.guard.trips(), 0u) << "no force pushes it";
  d.look(0, 300, false);
  d.look(std::numeric_limits<double>::quiet_NaN(), 3);
  EXPECT_TRUE(d.guard.inhibits());
  d.look(std::numeric_limits<double>::infinity(), 300, false);
  EXPECT_TRUE(d.guard.inhibits());
}

}  // namespace
}  // namespace tandem::control
