// A hand that is too fast, by hand-made samples a millisecond apart.
#include <gtest/gtest.h>

#include <limits>

#include "client/over_speed.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

struct Drive {
  void look(double speed, int samples = 1, bool active = true) {
    for (int i = 0; i < samples; ++i) guard.look(now += 1ms, speed, active);
  }
  OverSpeed guard;
  Time now{1s};
};

TEST(OverSpeed, TheThirdSampleOnEndLetsGoAndTwoDoNot) {
  Drive d;
  for (int n = 0; n < 100; ++n) {
    d.look(1.51, 2);
    d.look(1.5);  // the limit itself is allowed
  }
  EXPECT_FALSE(d.guard.holds_off());
  d.look(1.51, 2);
  EXPECT_FALSE(d.guard.holds_off());
  d.look(1.51);
  EXPECT_TRUE(d.guard.holds_off());
  EXPECT_EQ(d.guard.trips(), 1u);
}

TEST(OverSpeed, HoldsOffUntilTheHandWasCalmFor200Milliseconds) {
  Drive d;
  d.look(2, 3);
  d.look(0.1, 199, false);
  EXPECT_TRUE(d.guard.holds_off());
  d.look(1.6, 1, false);  // moves again: the wait begins anew
  d.look(0.1, 199, false);
  EXPECT_TRUE(d.guard.holds_off());
  d.look(0.1, 1, false);
  EXPECT_FALSE(d.guard.holds_off());
}

TEST(OverSpeed, TheThirdTimeIsLatchedUntilThePersonsButton) {
  Drive d;
  for (int n = 0; n < 3; ++n) {
    EXPECT_FALSE(d.guard.holds_off()) << n;
    d.look(2, 3);
    EXPECT_TRUE(d.guard.holds_off());
    d.look(0, 1000, false);
  }
  EXPECT_TRUE(d.guard.holds_off());
  EXPECT_TRUE(d.guard.latched());
  d.guard.reset();
  EXPECT_FALSE(d.guard.holds_off());
  EXPECT_FALSE(d.guard.latched());
}

TEST(OverSpeed, WhatIsNoNumberIsTooFastAndAHandWithoutForceMayBe) {
  Drive d;
  d.look(10, 100, false);
  EXPECT_EQ(d.guard.trips(), 0u) << "nobody pushes it";
  d.look(0, 300, false);
  d.look(std::numeric_limits<double>::quiet_NaN(), 3);
  EXPECT_TRUE(d.guard.holds_off());
  d.look(std::numeric_limits<double>::infinity(), 300, false);
  EXPECT_TRUE(d.guard.holds_off());
}

}  // namespace
}  // namespace tandem::client
