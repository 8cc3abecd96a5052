#include "common/control/leading_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tandem::control {
namespace {

PortSample sample(double x, double v) {
  PortSample out;
  out.x[0] = x;
  out.v[0] = v;
  return out;
}

TEST(LeadingHand, ExtrapolatesAFastHandByItsDelay) {
  LeadingHand hand;
  for (int i = 0; i < 2000; ++i) hand.step(true, sample(0.2 * i * 1e-3, 0.2), 3, 0.1);
  EXPECT_NEAR(hand.shown_x(0, 0.4 + 0.01), 0.41 + 0.02, 0.0002) << "the tip, and 100 ms of 0.2 m/s";
  EXPECT_EQ(hand.shown_x(2, 0.3), 0.3);
  EXPECT_NEAR(hand.shown_v(0), 0.2, 1e-3);
  EXPECT_LT(hand.steady_share(), 0.01) << "nothing of the prediction that is late";
}

/// A tremor of 0.42 mm at 2.3 Hz with its true velocity, 6 mm/s, after 200 ms.
TEST(LeadingHand, DampsTheExtrapolationOfAHandHeldStill) {
  LeadingHand hand;
  double most = 0, bold = 0;
  for (int i = 0; i < 6000; ++i) {
    const double t = i * 1e-3, w = 2 * std::numbers::pi * 2.3, x = 0.42e-3 * std::sin(w * t),
                 v = 0.42e-3 * w * std::cos(w * t);
    hand.step(true, sample(x, v), 3, 0.2);
    if (i < 3000) continue;
    most = std::max(most, std::abs(hand.steady_x(0)));
    bold = std::max(bold, std::abs(x + 0.2 * v));
  }
  EXPECT_GT(hand.steady_share(), 0.8);
  EXPECT_GT(bold, 1.2e-3);
  EXPECT_LT(most, 0.7e-3) << "about half";
}

TEST(LeadingHand, ReturnsTheReceivedPositionOfFreshData) {
  LeadingHand hand;
  for (int i = 0; i < 1000; ++i) hand.step(true, sample(0.01, 0), 3, 0.001);
  EXPECT_LT(hand.steady_share(), 1e-3);
  EXPECT_NEAR(hand.shown_x(0, 0.01), 0.01, 1e-9);
}

TEST(LeadingHand, RestartsAtThePositionOfANewHand) {
  LeadingHand hand;
  for (int i = 0; i < 1000; ++i) hand.step(true, sample(0.1, 0.5), 3, 0.1);
  hand.step(false, sample(0.1, 0.5), 3, 0.1);
  EXPECT_FALSE(hand.present());
  hand.step(true, sample(-0.1, 0), 3, 0.1);
  EXPECT_NEAR(hand.steady_x(0), -0.1, 1e-9);
}

TEST(LeadingHand, DoesNotExtrapolateAtAJointPort) {
  LeadingHand hand;
  for (int i = 0; i < 1000; ++i) hand.step(true, sample(0.1, 0.5), 0, 0.1);
  EXPECT_EQ(hand.shown_x(1, 0.02), 0.02);
  for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(hand.shown_v(a), 0);
}

TEST(LeadingHand, IsShownWithinTenMetresAndAtABoundedSpeed) {
  LeadingHand hand;
  for (int i = 0; i < 1000; ++i) hand.step(true, sample(9.99, 100), 3, 10);
  EXPECT_EQ(hand.shown_x(0, 9.99), LeadingHand::kTipMax);
  EXPECT_LE(std::abs(hand.shown_v(0)), Prediction::kVelocityMax);
}

}  // namespace
}  // namespace tandem::control
