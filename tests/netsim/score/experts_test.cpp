#include "netsim/score/experts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/netsim/score/lesson_maker.h"

namespace tandem::netsim::score {
namespace {

/// A lesson of a straight motion of `length_m` in 2 s, in which `missing` of the samples are not new.
LessonScores lesson_of(double length_m, double missing = 0) {
  LessonMaker maker;
  maker.ticks(2000).hand(0, [&](double t) { return LessonTriple{length_m * minimum_jerk(t / 2), 0, 0}; });
  auto& fresh = maker.lesson.seats[0].fresh;
  fresh.assign(2000, 1);
  for (std::size_t k = 0; k < static_cast<std::size_t>(2000 * missing); ++k) fresh[k * 2] = 0;
  LessonScores scores = maker.scores();
  scores.file = std::to_string(length_m);
  return scores;
}

TEST(Experts, GiveMedianDeviationAndPassMark) {
  const std::vector<LessonScores> experts{lesson_of(0.10), lesson_of(0.12), lesson_of(0.11), lesson_of(0.20),
                                          lesson_of(0.13)};
  const auto thresholds = thresholds_of(experts, "trainee");
  const Threshold* const path = threshold_of(thresholds, "whole", Metric::kPathLength);
  ASSERT_NE(path, nullptr);
  // Deviations from the median 0.12: 0.02, 0, 0.01, 0.08, 0.01; their median is 0.01.
  EXPECT_NEAR(path->median, 0.12, 1e-4);
  EXPECT_NEAR(path->deviation, 0.01, 1e-4);
  EXPECT_NEAR(path->pass_mark, 0.12 + 1.4826 * 0.01, 2e-4);
  EXPECT_TRUE(passes(*path, Metric::kPathLength, 0.13));
  EXPECT_FALSE(passes(*path, Metric::kPathLength, 0.14));
  // All lessons take 2 s: a deviation of 0 becomes 1 %.
  EXPECT_NEAR(threshold_of(thresholds, "whole", Metric::kTime)->pass_mark, 2 + 1.4826 * 0.02, 1e-9);
  EXPECT_EQ(threshold_of(thresholds, "whole", Metric::kSpeedPeak), nullptr) << "neither side is better";
  EXPECT_EQ(threshold_of(thresholds, "phase:x", Metric::kPathLength), nullptr);
  const Threshold* const smooth = threshold_of(thresholds, "whole", Metric::kSparc);
  ASSERT_NE(smooth, nullptr);
  EXPECT_LE(smooth->pass_mark, smooth->median) << "higher is better";
}

TEST(Experts, NeedThreeValuesThatAreNotWithheld) {
  EXPECT_EQ(
      threshold_of(thresholds_of(std::vector{lesson_of(0.1), lesson_of(0.2)}, "trainee"), "whole", Metric::kPathLength),
      nullptr);
  const std::vector<LessonScores> poor{lesson_of(0.1), lesson_of(0.2), lesson_of(0.3, 0.3)};
  EXPECT_EQ(threshold_of(thresholds_of(poor, "trainee"), "whole", Metric::kPathLength), nullptr);
}

TEST(Experts, SetNoMarksForTheLinkAndThePassivityOfTheChannel) {
  std::vector<LessonScores> experts;
  for (const double length : {0.1, 0.2, 0.3}) {
    LessonScores lesson = lesson_of(length);
    for (double& value : lesson.seats[0].parts[0].values)
      if (!std::isfinite(value)) value = length;  // as if everything were recorded
    experts.push_back(std::move(lesson));
  }
  const auto thresholds = thresholds_of(experts, "trainee");
  for (const MetricRow& row : metric_rows())
    EXPECT_EQ(threshold_of(thresholds, "whole", row.metric) != nullptr,
              row.better != Better::kNeither && row.group != MetricGroup::kLink && row.group != MetricGroup::kPassivity)
        << row.key;
  for (const LearningCurve& curve : learning_curves(experts, "trainee", thresholds))
    EXPECT_NE(row_of(curve.metric).group, MetricGroup::kLink) << row_of(curve.metric).key;
}

TEST(Cusum, FollowsItsFormulas) {
  const Cusum c = cusum({true, false, true, true, true, true, true, true, true, true, true});
  const double p = std::log(0.4 / 0.2), q = std::log(0.8 / 0.6);
  EXPECT_NEAR(c.step, q / (p + q), 1e-12);
  EXPECT_NEAR(c.step, 0.2933, 5e-5);
  EXPECT_NEAR(c.low, std::log(9) / (p + q), 1e-12);
  EXPECT_NEAR(c.high, c.low, 1e-12) << "equal error probabilities";
  EXPECT_NEAR(c.sums[1], 1 - 2 * c.step, 1e-12);
  EXPECT_NEAR(c.sums.back(), 1 - 11 * c.step, 1e-12);
  EXPECT_EQ(c.verdict, Cusum::Verdict::kUndecided) << "-2.23 is not below -2.24";
  EXPECT_EQ(cusum(std::vector<bool>(8, true)).verdict, Cusum::Verdict::kCompetent);
  EXPECT_EQ(cusum(std::vector<bool>(4, false)).verdict, Cusum::Verdict::kDeficient);
  EXPECT_EQ(cusum({}).verdict, Cusum::Verdict::kUndecided);
}

TEST(LearningCurve, HasTheSlopeAndLeavesOutWithheldSessions) {
  const std::vector<LessonScores> experts{lesson_of(0.10), lesson_of(0.11), lesson_of(0.12)};
  const std::vector<LessonScores> sessions{lesson_of(0.20), lesson_of(0.18), lesson_of(0.5, 0.3), lesson_of(0.14),
                                           lesson_of(0.12)};
  const auto curves = learning_curves(sessions, "trainee", thresholds_of(experts, "trainee"));
  const auto path = std::ranges::find(curves, Metric::kPathLength, &LearningCurve::metric);
  ASSERT_NE(path, curves.end());
  ASSERT_EQ(path->points.size(), 5u);
  EXPECT_FALSE(path->points[2].counts);
  EXPECT_EQ(path->points[2].trust, Trust::kWithheld);
  EXPECT_FALSE(path->points[0].passed);
  EXPECT_TRUE(path->points[4].passed);
  EXPECT_EQ(path->sum.sums.size(), 4u);
  EXPECT_NEAR(path->slope, -0.02, 1e-3);
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoMiddleValues) {
  EXPECT_EQ(median_of({3, 1, 2}), 2);
  EXPECT_EQ(median_of({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median_of({})));
}

}  // namespace
}  // namespace tandem::netsim::score
