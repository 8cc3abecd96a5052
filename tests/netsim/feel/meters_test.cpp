#include "netsim/feel/meters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "netsim/feel/feel_trace.h"

namespace tandem::netsim {
namespace {

constexpr double kRate = 1000;
constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> times(double seconds) {
  std::vector<double> t;
  for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) t.push_back(i / kRate);
  return t;
}
std::vector<hal::Vec3> wave(double seconds, double amplitude, double hz) {
  std::vector<hal::Vec3> out;
  for (const double t : times(seconds)) out.emplace_back(amplitude * std::sin(kTurn * hz * t), 0, 0);
  return out;
}

TEST(FeelMeters, AlongXKeepsTheFirstCoordinateOfEachRow) {
  const std::vector<hal::Vec3> rows{{1, 2, 3}, {-4, 5, 6}};
  EXPECT_EQ(along_x(rows), (std::vector<double>{1, -4}));
}

TEST(FeelMeters, LargerOfANumberAndNanIsNan) {
  EXPECT_EQ(larger(-2, 1), 1);
  EXPECT_TRUE(std::isnan(larger(NAN, 1)));
  EXPECT_TRUE(std::isnan(larger(1, NAN)));
}

TEST(FeelTrace, PartHoldsTheRowsFromTheFirstTimeToBeforeTheSecond) {
  FeelTrace trace;
  trace.t = {0, 1, 2, 3};
  const std::vector<double> column{10, 11, 12, 13};
  const auto part = trace.part(column, 1, 3);
  EXPECT_EQ(std::vector<double>(part.begin(), part.end()), (std::vector<double>{11, 12}));
  EXPECT_TRUE(trace.part(column, 3, 1).empty());
}

TEST(FeelMeters, RmsOfASineIsItsAmplitudeOverRootTwo) {
  EXPECT_NEAR(rms(wave(4, 3.0, 5)), 3.0 / std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(std::isnan(rms(Series{})));
}

TEST(FeelMeters, RmsLagOfACircleIsTheChordOfTheLag) {
  std::vector<hal::Vec3> circle;
  for (const double t : times(4))
    circle.emplace_back(0.05 * std::cos(kTurn * 0.5 * t), 0, 0.05 * std::sin(kTurn * 0.5 * t));
  // 100 ms of a period of 2 s: a chord of 18 degrees.
  EXPECT_NEAR(rms_lag(circle, 100), 2 * 0.05 * std::sin(kTurn * 0.5 * 0.1 / 2), 1e-9);
  EXPECT_DOUBLE_EQ(rms_lag(circle, 0), 0);
  EXPECT_TRUE(std::isnan(rms_lag(circle, circle.size())));
}

TEST(FeelMeters, SlopeFindsASpringAndIgnoresRowsOutsideTheBand) {
  std::vector<double> x, f;
  for (int i = 0; i < 1000; ++i) {
    x.push_back(1e-5 * i);
    f.push_back(std::min(3.3, 400 * x.back()));  // saturates at 8.25 mm
  }
  EXPECT_NEAR(slope(x, f, 0.5, 3.0), 400, 1e-6);
  EXPECT_LT(slope(x, f, 0.5, 4.0), 390) << "saturated rows must change the slope when they are within the band";
  EXPECT_TRUE(std::isnan(slope(x, f, 5, 6)));
}

TEST(FeelMeters, ReturnNoSlopeForAPoint) {
  const std::vector<double> same(100, 1.0);
  EXPECT_TRUE(std::isnan(slope(same, same, 0, 2)));
}

TEST(FeelMeters, HarmonicFindsAmplitudeAndPhaseBesideOffsetAndNoise) {
  const std::vector<double> t = times(4);
  std::vector<double> x;
  for (const double at : t) x.push_back(0.7 + 2 * std::cos(kTurn * 3 * at + 0.4) + 0.5 * std::sin(kTurn * 11 * at));
  const std::complex<double> found = harmonic(t, x, 3);
  EXPECT_NEAR(std::abs(found), 2, 1e-6);
  EXPECT_NEAR(std::arg(found), 0.4, 1e-6);
  EXPECT_NEAR(std::abs(harmonic(t, x, 7)), 0, 1e-6);
}

TEST(FeelMeters, MeasureOnlyTheFastPartByRmsAbove) {
  // 15 Hz of 0.1 N on a drift of 1 N and a slow wave of 0.3 Hz: only the 15 Hz part counts.
  std::vector<hal::Vec3> force = wave(5, 0.1, 15);
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double t = static_cast<double>(i) / kRate;
    force[i] += hal::Vec3(0.2 * t + 0.5 * std::sin(kTurn * 0.3 * t), 0, 0);
  }
  EXPECT_NEAR(rms_above(force, 1, kRate), 0.1 / std::sqrt(2.0), 0.002);
  EXPECT_LT(rms_above(wave(5, 1, 0.3), 1, kRate), 0.01);
}

TEST(FeelMeters, RmsAboveOfAWaveAddsItsAxes) {
  std::vector<hal::Vec3> force;
  for (const double t : times(5)) force.emplace_back(0.3 * std::sin(kTurn * 7 * t), 0.4 * std::sin(kTurn * 9 * t), 0);
  EXPECT_NEAR(rms_above(force, 1, kRate), 0.5 / std::sqrt(2.0), 0.005);
}

TEST(FeelMeters, LargestStepIsPerMillisecondAtEveryRate) {
  std::vector<hal::Vec3> jump(100, hal::Vec3::Zero());
  for (std::size_t i = 50; i < 100; ++i) jump[i] = hal::Vec3(0, 0.3, 0.4);
  EXPECT_NEAR(largest_step_per_ms(jump, 1000), 0.5, 1e-12);
  EXPECT_NEAR(largest_step_per_ms(jump, 4000), 0.5, 1e-12) << "within four rows of 0.25 ms";
  EXPECT_NEAR(largest_step_per_ms(jump, 100), 0.05, 1e-12) << "a row of 10 ms";
}

TEST(FeelMeters, OvershootIsMeasuredFromTheEndOrFromTheHand) {
  std::vector<double> hand, tool;
  for (int i = 0; i < 1000; ++i) {
    hand.push_back(i < 100 ? 2e-4 * i : 0.020);
    tool.push_back(i < 100 ? 2e-4 * i : i < 300 ? 0.030 : 0.020);
  }
  EXPECT_NEAR(overshoot(tool), 0.5, 1e-9);
  EXPECT_NEAR(overshoot_above(tool, hand), 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(overshoot(hand), 0);
  hand[150] = 0.024;  // the hand itself moved further: not caused by the tool
  EXPECT_NEAR(overshoot_above(tool, hand), 0.3, 1e-9);
  EXPECT_TRUE(std::isnan(overshoot(std::vector<double>(100, 1.0))));
}

}  // namespace
}  // namespace tandem::netsim
