#include "netsim/score/smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "netsim/score/filters.h"

namespace tandem::netsim::score {
namespace {

/// The conformance signal of the SPARC reference package.
std::vector<double> bell() {
  std::vector<double> speed;
  for (int k = 0; k < 200; ++k) {
    const double t = -1 + 0.01 * k;
    speed.push_back(std::exp(-5 * t * t));
  }
  return speed;
}

TEST(Smoothness, HitsTheConformanceVectors) {
  EXPECT_NEAR(sparc(bell(), 100), -1.41403, 1e-5);
  EXPECT_NEAR(dimensionless_jerk(bell(), 100), -335.74684, 1e-5);
  EXPECT_NEAR(log_dimensionless_jerk(bell(), 100), -5.81636, 1e-5);
}

TEST(Smoothness, DoesNotDependOnTheScaleOfSpeed) {
  std::vector<double> fast = bell();
  for (double& s : fast) s *= 37;
  EXPECT_NEAR(sparc(fast, 100), sparc(bell(), 100), 1e-12);
  EXPECT_NEAR(dimensionless_jerk(fast, 100), dimensionless_jerk(bell(), 100), 1e-9);
  EXPECT_NEAR(motion_frequency_95(fast, 100), motion_frequency_95(bell(), 100), 1e-12);
}

TEST(Smoothness, IsWorseForTwoMovementsThanForOne) {
  std::vector<double> two = bell();
  const std::vector<double> second = bell();
  two.insert(two.end(), second.begin(), second.end());
  EXPECT_LT(sparc(two, 100), sparc(bell(), 100) - 0.1);
  EXPECT_LT(log_dimensionless_jerk(two, 100), log_dimensionless_jerk(bell(), 100) - 0.1);
}

TEST(Smoothness, IsAbsentWithoutMotionAndForBrokenSignals) {
  for (const std::vector<double>& none :
       {std::vector<double>{}, std::vector<double>(3), std::vector<double>(500), std::vector<double>(100, NAN)}) {
    EXPECT_TRUE(std::isnan(sparc(none, 100)));
    EXPECT_TRUE(std::isnan(dimensionless_jerk(none, 100)));
    EXPECT_TRUE(std::isnan(log_dimensionless_jerk(none, 100)));
    EXPECT_TRUE(std::isnan(motion_frequency_95(none, 100)));
  }
  const std::vector<double> constant(500, 0.1);
  EXPECT_TRUE(std::isnan(log_dimensionless_jerk(constant, 100))) << "no jerk has no logarithm";
  EXPECT_TRUE(std::isnan(motion_frequency_95(constant, 100)));
}

TEST(Smoothness, FindsTheFrequencyOfAVibration) {
  std::vector<double> speed;
  for (int k = 0; k < 1024; ++k) speed.push_back(1 + 0.1 * std::sin(2 * std::numbers::pi * 6.25 * k / 100));
  EXPECT_NEAR(motion_frequency_95(speed, 100), 6.25, 0.1);
}

TEST(Filters, HalveThePowerAtTheCutoffWithoutPhase) {
  std::vector<double> signal;
  for (int k = 0; k < 4000; ++k) signal.push_back(std::sin(2 * std::numbers::pi * 10 * k / 1000.0));
  const std::vector<double> input = signal;
  low_pass(signal, 10, 1000);
  for (int k = 1000; k < 3000; ++k)
    ASSERT_NEAR(signal[static_cast<std::size_t>(k)], input[static_cast<std::size_t>(k)] / std::numbers::sqrt2, 2e-3);
}

TEST(Filters, LeaveConstantsAndRampsToTheirEnds) {
  std::vector<double> ramp;
  for (int k = 0; k < 500; ++k) ramp.push_back(3 + 0.25 * k);
  const std::vector<double> input = ramp;
  low_pass(ramp, 10, 1000);
  for (std::size_t k = 0; k < ramp.size(); ++k) ASSERT_NEAR(ramp[k], input[k], 1e-3 * std::abs(input[k])) << k;
  std::vector<double> constant(100, 7.5);
  low_pass(constant, 10, 1000);
  for (const double v : constant) ASSERT_NEAR(v, 7.5, 1e-9);
}

TEST(Filters, LeaveSignalsThatAreTooShortOrTooSlowAsTheyAre) {
  std::vector<double> three{1, 5, 2}, slow{1, 5, 2, 8, 3};
  low_pass(three, 10, 1000);
  EXPECT_EQ(three, (std::vector<double>{1, 5, 2}));
  low_pass(slow, 10, 20);
  EXPECT_EQ(slow, (std::vector<double>{1, 5, 2, 8, 3}));
}

TEST(Filters, DifferentiatePolynomialsExactly) {
  std::vector<LessonTriple> x;
  for (int k = 0; k < 50; ++k) {
    const double t = k / 100.0;
    x.push_back({t * t * t, 2 * t * t, 4 * t});
  }
  const std::vector<LessonTriple> v = derivative(std::span<const LessonTriple>(x), 100);
  EXPECT_NEAR(v[20][1], 4 * 0.20, 1e-12) << "parabola";
  EXPECT_NEAR(v[0][2], 4, 1e-12) << "one-sided at the end";
  const std::vector<double> jerk = squared_jerk(x, 100);
  ASSERT_EQ(jerk.size(), 46u);
  for (const double j : jerk) EXPECT_NEAR(j, 36, 1e-6) << "the third derivative of t^3 is 6";
}

}  // namespace
}  // namespace tandem::netsim::score
