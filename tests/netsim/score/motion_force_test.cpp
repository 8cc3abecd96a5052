// Metrics of motion, force and contact against numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/netsim/score/lesson_maker.h"

namespace tandem::netsim::score {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(MotionScores, OfAStraightSteadyMotion) {
  LessonMaker maker;
  maker.ticks(2000).hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kTime), 2, 1e-12);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kPathLength), 0.1999, 2e-4);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kStraightShare), 1, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kSpeedMean), 0.1, 1e-4);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kIdleTime), 0, 1e-12);
  EXPECT_EQ(value_of(s, "trainee", Metric::kWorkspace), 0) << "no extent along y and z";
  EXPECT_TRUE(std::isnan(value_of(s, "trainee", Metric::kForcePeak))) << "no force is recorded";
}

TEST(MotionScores, OfACircle) {
  LessonMaker maker;
  maker.lesson.scene.phases = {{"inner", 1, 3, false}};
  maker.ticks(4000).hand(0, [](double t) {
    return LessonTriple{0.05 * std::cos(2 * kPi * 0.25 * t), 0.05 * std::sin(2 * kPi * 0.25 * t), 0.01 * t};
  });
  const LessonScores s = maker.scores();
  const double speed = std::hypot(2 * kPi * 0.25 * 0.05, 0.01);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kPathLength), 4 * speed, 1e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kSpeedPeak), speed, 2e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kStraightShare), 0.04 / (4 * speed), 2e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWorkspace), 0.1 * 0.1 * 0.04, 1e-6);
  // Away from the ends of the recording, where the filter does not know how the motion goes on.
  EXPECT_NEAR(value_of(s, "trainee", Metric::kSquaredJerk, "phase:inner"),
              std::pow(0.05, 2) * std::pow(2 * kPi * 0.25, 6), 1e-3);
}

TEST(MotionScores, OfAMinimumJerkMotionAndARest) {
  LessonMaker maker;
  // 0.3 m in 2 s, then 1 s of rest.
  maker.ticks(3000).hand(0, [](double t) { return LessonTriple{0.3 * minimum_jerk(t / 2), 0.01, -0.02}; });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kSpeedPeak), 1.875 * 0.3 / 2, 2e-3);
  EXPECT_EQ(value_of(s, "trainee", Metric::kSpeedPeaks), 1);
  // Speed 30 s^2 (1-s)^2 L/T below 5 mm/s: s < 0.0343 at either end, 0.069 of 2 s, and 1 s of rest.
  EXPECT_NEAR(value_of(s, "trainee", Metric::kIdleTime), 1 + 2 * 2 * 0.0343, 0.02);
  // The integral of the squared jerk is 720 L^2 / T^5 over the motion of 2 s; the piece has 3 s.
  EXPECT_NEAR(value_of(s, "trainee", Metric::kNormalisedJerk), 720 * std::pow(3.0 / 2, 5), 720 * 0.4);
  EXPECT_GT(value_of(s, "trainee", Metric::kSparc), -1.7);
}

TEST(MotionScores, OfTremorAreWorseInEveryMeasureOfSmoothness) {
  LessonMaker smooth, shaky;
  const auto motion = [](double t) { return 0.2 * minimum_jerk(t / 2); };
  smooth.ticks(2000).hand(0, [&](double t) { return LessonTriple{motion(t), 0, 0}; });
  shaky.ticks(2000).hand(0,
                         [&](double t) { return LessonTriple{motion(t) + 0.002 * std::sin(2 * kPi * 6 * t), 0, 0}; });
  const LessonScores a = smooth.scores(), b = shaky.scores();
  EXPECT_LT(value_of(b, "trainee", Metric::kLogJerk), value_of(a, "trainee", Metric::kLogJerk) - 1);
  EXPECT_LT(value_of(b, "trainee", Metric::kSparc), value_of(a, "trainee", Metric::kSparc) - 0.3);
  EXPECT_GT(value_of(b, "trainee", Metric::kNormalisedJerk), 10 * value_of(a, "trainee", Metric::kNormalisedJerk));
  EXPECT_GT(value_of(b, "trainee", Metric::kMotionFrequency), 5);
  EXPECT_LT(value_of(a, "trainee", Metric::kMotionFrequency), 3);
}

TEST(MotionScores, OfARestHaveNoSmoothness) {
  LessonMaker maker;
  maker.ticks(2000).hand(0, [](double t) { return LessonTriple{1e-6 * std::sin(40 * t), 0, 0}; });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kIdleTime), 2, 1e-9);
  for (const Metric metric : {Metric::kSparc, Metric::kLogJerk, Metric::kMotionFrequency, Metric::kNormalisedJerk})
    EXPECT_TRUE(std::isnan(value_of(s, "trainee", metric))) << row_of(metric).key;
}

TEST(ForceScores, OfAConstantForceAlongAMotion) {
  LessonMaker maker;
  maker.ticks(1001).hand(0, [](double t) { return LessonTriple{0.1 * t, 0, 0}; }).force(0, [](double) {
    return LessonTriple{2, 0, 0};
  });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForcePeak), 2, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceMean), 2, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceRms), 2, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kImpulse), 2 * 1.001, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceRatePeak), 0, 1e-6);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWork), 0.2, 2e-4) << "2 N along 0.1 m";
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceDeviation), 0, 1e-6);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceEllipsoid), 0, 1e-9);
  EXPECT_EQ(value_of(s, "trainee", Metric::kExcessTime), 0) << "2 N is not above the limit of 2 N";
  EXPECT_NEAR(value_of(LessonMaker(maker).force(0, [](double) { return LessonTriple{0, 0, 2.1}; }).scores(), "trainee",
                       Metric::kExcessTime),
              1.001, 1e-9);
}

TEST(ForceScores, OfARampAndOfForcesAcrossTheAxis) {
  LessonMaker maker;
  maker.lesson.scene.tools[0].environment.wall = WallSpec{};  // normal to x
  maker.ticks(1001).hand(0, [](double) { return LessonTriple{0.01, 0, 0}; }).force(0, [](double t) {
    return LessonTriple{3 * t, 4 * t, 0};
  });
  const LessonScores s = maker.scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceRateRms), 5, 1e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceRms), 5 / std::sqrt(3.0), 5e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kForceDeviation), 5 / std::sqrt(12.0), 5e-3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kOffAxisShare), 0.8, 1e-6);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWork), 0, 1e-9) << "the hand rests";
}

TEST(ForceScores, OfIndependentAxesHaveTheVolumeOfTheirEllipsoid) {
  LessonMaker maker;
  // Each axis: amplitude a at its own whole number of periods, so its deviation is a / sqrt(2).
  maker.ticks(10000).hand(0, [](double) { return LessonTriple{}; }).force(0, [](double t) {
    return LessonTriple{std::sin(2 * kPi * t), 2 * std::sin(2 * kPi * 0.5 * t), 3 * std::sin(2 * kPi * 0.3 * t)};
  });
  EXPECT_NEAR(value_of(maker.scores(), "trainee", Metric::kForceEllipsoid),
              4.0 / 3 * kPi * 1 * 2 * 3 / std::pow(2.0, 1.5), 0.02);
}

TEST(ContactScores, CountContactsAndTheirForces) {
  LessonMaker maker;
  // Contacts at [0.2, 0.5) with an interruption of 10 ms, and at [0.7, 0.8).
  maker.ticks(1000)
      .hand(0, [](double) { return LessonTriple{}; })
      .tool([](double) { return LessonTriple{}; },
            [](double t) {
              const bool first = t >= 0.2 - 1e-9 && t < 0.5 - 1e-9 && !(t >= 0.3 - 1e-9 && t < 0.31 - 1e-9);
              const bool second = t >= 0.7 - 1e-9 && t < 0.8 - 1e-9;
              return LessonTriple{first ? -1.0 : second ? -3.0 : 0.0, 0, 0};
            });
  maker.fill<double>(maker.lesson.tools[0].penetration, [](double t) { return t < 0.7 ? 0.001 : 0.002; });
  const LessonScores s = maker.scores();
  EXPECT_EQ(value_of(s, "trainee", Metric::kContacts), 2);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kContactTimeMean), (0.3 + 0.1) / 2, 1e-9);
  EXPECT_EQ(value_of(s, "trainee", Metric::kContactForcePeak), 3);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kContactImpulse), 0.29 + 0.3, 1e-9);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kContactForceMean), 0.59 / 0.4, 1e-9);
  EXPECT_EQ(value_of(s, "trainee", Metric::kPenetrationMax), 0.002);
}

TEST(Metrics, HaveDistinctKeysAndFiniteWords) {
  for (const MetricRow& row : metric_rows()) {
    EXPECT_EQ(metric_named(row.key), row.metric) << row.key;
    EXPECT_FALSE(row.definition.empty());
    EXPECT_EQ(value_text(row, NAN), "–");
    EXPECT_EQ(value_text(row, 0), "0");
  }
  EXPECT_EQ(value_with_unit(row_of(Metric::kPathLength), 0.0341), "34.1 mm");
  EXPECT_EQ(value_with_unit(row_of(Metric::kForcePeak), 12), "12.0 N");
  EXPECT_EQ(value_with_unit(row_of(Metric::kContacts), 3), "3");
}

}  // namespace
}  // namespace tandem::netsim::score
