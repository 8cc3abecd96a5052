#include "common/control/silence_tank.h"

#include <gtest/gtest.h>

#include <limits>

namespace tandem::control {
namespace {

/// 20 mJ for a handle of 0.1 kg on one axis.
SilenceTank tank_of_20_mj() { return SilenceTank({.dof = 1, .mass = 0.1}); }

TEST(SilenceTank, BooksTheHeldEffortAlongTheWayOfTheHand) {
  SilenceTank tank = tank_of_20_mj();
  tank.start_at({0.5});
  tank.measure({2}, {0.503}, true);
  EXPECT_NEAR(tank.given(), 0.006, 1e-15);
  tank.measure({-1}, {0.505}, true);
  EXPECT_NEAR(tank.given(), 0.004, 1e-15) << "the hand returned 2 mJ";
  tank.measure({-1}, {0.506}, false);
  EXPECT_NEAR(tank.given(), 0.004, 1e-15) << "after a standstill nothing was returned";
  tank.note_loss();
  tank.refill();
  EXPECT_EQ(tank.given(), 0);
  EXPECT_NEAR(tank.given_max(), 0.004, 1e-15);
}

TEST(SilenceTank, IgnoresPositionsThatAreNotFinite) {
  SilenceTank tank = tank_of_20_mj();
  tank.measure({2}, {std::numeric_limits<double>::quiet_NaN()}, true);
  EXPECT_EQ(tank.given(), 0);
  tank.measure({2}, {0.001}, true);
  EXPECT_NEAR(tank.given(), 0.002, 1e-15) << "the way counts from the last finite position";
}

TEST(SilenceTank, AllowsAnEffortThatTheRestOfTheTankPays) {
  // The next step of 1 ms may give 1 N (v + 1 N 1 ms / 0.1 kg) 1 ms: 20 mJ at v = 19.99 m/s.
  SilenceTank tank = tank_of_20_mj();
  EXPECT_TRUE(tank.allows({1}, {19.98}));
  EXPECT_FALSE(tank.allows({1}, {20}));
  tank.measure({1}, {0.015}, true);  // 15 mJ are given
  EXPECT_TRUE(tank.allows({1}, {4.98}));
  EXPECT_FALSE(tank.allows({1}, {5}));
  tank.set_pace(0.002);  // steps of 2 ms: 1 N (v + 1 N 2 ms / 0.1 kg) 2 ms
  EXPECT_TRUE(tank.allows({1}, {2.47}));
  EXPECT_FALSE(tank.allows({1}, {2.49}));
}

TEST(SilenceTank, AllowsBrakingIfVelocityAndDisplacementShowIt) {
  SilenceTank tank = tank_of_20_mj();
  tank.measure({0}, {0.03}, true);  // the hand moved by +30 mm
  EXPECT_TRUE(tank.allows({-1}, {30})) << "at this speed a pushing effort of 1 N would give 30 mJ";
  EXPECT_FALSE(tank.allows({1}, {-30})) << "the velocity says braking, the displacement does not";
}

TEST(SilenceTank, ForgetsALongStepWithinASecond) {
  SilenceTank tank = tank_of_20_mj();
  tank.set_pace(0.03);
  EXPECT_FALSE(tank.allows({1}, {1}));
  for (int i = 0; i < 3000; ++i) tank.set_pace(0.001);
  EXPECT_TRUE(tank.allows({1}, {1}));
}

TEST(SilenceTank, MeasuresAtTheTip) {
  // A joint with a lever of 0.2 m: 0.2 N m are 1 N, and 5 rad/s are 1 m/s.
  SilenceTank tank({.dof = 1, .scale = {0.04}, .mass = 0.1});
  EXPECT_TRUE(tank.allows({0.2}, {19.98 / 0.2}));
  EXPECT_FALSE(tank.allows({0.2}, {20 / 0.2}));
}

}  // namespace
}  // namespace tandem::control
