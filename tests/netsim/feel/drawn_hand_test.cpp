#include "netsim/feel/drawn_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "netsim/feel/meters.h"

namespace tandem::netsim {
namespace {

std::vector<hal::Vec3> unsteady(const DrawnHand& hand) {
  std::vector<hal::Vec3> out;
  for (int i = 0; i < 15'000; ++i) out.push_back(hand.unsteadiness(1e-3 * i));
  return out;
}

TEST(DrawnHand, HasIntentionNoiseAndTremorOfTheSpecifiedSize) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<hal::Vec3> all = unsteady({HandKind::kDrawn, seed, 0});
    // Three axes: 0.3 mm per axis, and tremor of 0.07 to 0.13 mm.
    EXPECT_NEAR(rms(all), 0.3e-3 * std::sqrt(3.0), 0.1e-3);
    const double tremor = rms_above(all, 6, 1000);
    EXPECT_GT(tremor, 0.07e-3 * std::sqrt(1.5) * 0.9);
    EXPECT_LT(tremor, 0.13e-3 * std::sqrt(1.5) * 1.1);
    EXPECT_LT(rms_above(all, 13, 1000), 0.005e-3);
  }
}

TEST(DrawnHand, ImpedanceDiffersBetweenSeedsAndHandsWithinItsRange) {
  double least = 1e9, most = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const HandSpec hand = DrawnHand(HandKind::kDrawn, seed, 0).with_impedance(HandModel::kRecorded, 1000, 10, 0.1);
    EXPECT_GE(hand.k, 500 * 0.999);
    EXPECT_LE(hand.k, 1500 * 1.001);
    least = std::min(least, hand.k);
    most = std::max(most, hand.k);
  }
  EXPECT_LT(least, 600);
  EXPECT_GT(most, 1300);
  EXPECT_NE(DrawnHand(HandKind::kDrawn, 7, 0).factor(1, 0.5, 1.5),
            DrawnHand(HandKind::kDrawn, 7, 1).factor(1, 0.5, 1.5));
}

TEST(DrawnHand, IsAFunctionOfItsSeed) {
  EXPECT_EQ(DrawnHand(HandKind::kDrawn, 3, 0).unsteadiness(1.234),
            DrawnHand(HandKind::kDrawn, 3, 0).unsteadiness(1.234));
}

TEST(DrawnHand, KeepsPlainHandsSteadyAndAlike) {
  const DrawnHand hand{HandKind::kPlain, 5, 0};
  EXPECT_EQ(hand.unsteadiness(2.5), hal::Vec3::Zero());
  EXPECT_DOUBLE_EQ(hand.with_impedance(HandModel::kRecorded, 1000, 10, 0.1).k, 1000);
}

TEST(DrawnHand, MovesAlongThePathFromRest) {
  const auto path = [](double t) { return hal::Vec3(0.02 * t, 0, 0); };
  const auto motion = DrawnHand(HandKind::kDrawn, 1, 0).move(path, 5);
  hal::sim::RecordedMotion::Cursor cursor;
  EXPECT_NEAR(motion->at(0, cursor).x.norm(), 0, 1e-12);
  EXPECT_NEAR((motion->at(3.0011, cursor).x - path(3.0011)).norm(), 0, 1.5e-3);
  EXPECT_NEAR(DrawnHand(HandKind::kPlain, 1, 0).move(path, 5)->at(3.0011, cursor).x.x(), 0.060022, 1e-9);
  EXPECT_EQ(motion->at(9, cursor).v, hal::Vec3::Zero()) << "the end is held";
}

}  // namespace
}  // namespace tandem::netsim
