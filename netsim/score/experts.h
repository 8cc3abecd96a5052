#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "netsim/score/lesson_scores.h"

/// A learner against experts: thresholds, learning curve, cumulative sum.
namespace tandem::netsim::score {

/// Threshold of one metric in one part.
struct Threshold {
  std::size_t experts = 0;  ///< lessons with a value that is not withheld
  double median = kUnknown;
  double deviation = kUnknown;  ///< median absolute deviation from the median; at least 1 % of the median
  /// Median, moved to the worse side by 1.4826 deviations, which is one standard deviation of a normal distribution.
  double pass_mark = kUnknown;
  [[nodiscard]] bool exists() const noexcept { return pass_mark == pass_mark; }
};
/// Fewest expert recordings for a threshold.
inline constexpr std::size_t kExpertsMin = 3;

/// Thresholds of one part. Metrics without a better side, and with fewer than kExpertsMin values, have none.
struct PartThresholds {
  std::string key;
  std::array<Threshold, kMetricCount> metrics{};
};

/// @param seat  whose scores are the experts'
[[nodiscard]] std::vector<PartThresholds> thresholds_of(std::span<const LessonScores> experts, const std::string& seat);
[[nodiscard]] const Threshold* threshold_of(const std::vector<PartThresholds>& all, std::string_view part,
                                            Metric metric) noexcept;
/// Whether a value is at least as good as the pass mark.
[[nodiscard]] bool passes(const Threshold& threshold, Metric metric, double value) noexcept;

/// Learning-curve cumulative sum of passed and failed sessions.
/// Source [Bolsin & Colson 2000]: "The use of the Cusum technique in the assessment of trainee competence in new
/// procedures", Int. J. for Quality in Health Care 12(5). S rises by 1 - s for a failure and falls by s for a success;
/// s = Q / (P + Q), P = ln(p1 / p0), Q = ln((1 - p0) / (1 - p1)). Below -h0 the failure rate is at most p0, above h1 it
/// is p1 or more; h0 = ln((1 - alpha) / beta) / (P + Q), h1 = ln((1 - beta) / alpha) / (P + Q).
struct CusumOptions {
  double acceptable = 0.2, unacceptable = 0.4;  ///< failure rates p0, p1
  double alpha = 0.1, beta = 0.1;               ///< error probabilities
};
struct Cusum {
  double step = 0, low = 0, high = 0;  ///< s, h0, h1
  std::vector<double> sums;            ///< after each session
  /// Competent: the sum went below -h0; deficient: above h1; at the end of the sessions neither: undecided.
  enum class Verdict : std::uint8_t { kUndecided, kCompetent, kDeficient } verdict = Verdict::kUndecided;
};
/// @param passed  by session, in time
[[nodiscard]] Cusum cusum(const std::vector<bool>& passed, const CusumOptions& options = {});

/// One metric of one part over a learner's sessions.
struct CurvePoint {
  std::string file;
  double value = kUnknown;
  Trust trust = Trust::kAbsent;
  bool passed = false;  ///< false too if the value is withheld or absent, see `counts`
  bool counts = false;  ///< has a value that is not withheld
};
struct LearningCurve {
  std::string part;
  Metric metric = Metric::kTime;
  Threshold threshold;
  std::vector<CurvePoint> points;
  double slope = kUnknown;  ///< Theil-Sen estimate: median of all slopes between two sessions [SI per session]
  Cusum sum;                ///< of the sessions that count
};

/// Curves of all metrics with a threshold, in the order of parts and metrics.
/// @param sessions  of the learner, in time
[[nodiscard]] std::vector<LearningCurve> learning_curves(std::span<const LessonScores> sessions,
                                                         const std::string& seat,
                                                         const std::vector<PartThresholds>& thresholds,
                                                         const CusumOptions& options = {});

/// Median of the values; NaN if there are none.
[[nodiscard]] double median_of(std::vector<double> values);

}  // namespace tandem::netsim::score
