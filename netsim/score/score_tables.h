#pragma once

#include <string>

#include "netsim/score/score_output.h"

/// Tables of a learner's report as HTML. All texts of the recording are escaped.
namespace tandem::netsim::score {

/// Main scores of a seat in plain words, against the experts if there are thresholds.
[[nodiscard]] std::string main_scores_html(const ScoreResult& result, const SeatScore& seat);
/// Every score of a seat, one column per part, with reasons of flags below.
[[nodiscard]] std::string all_scores_html(const SeatScore& seat);
/// Quality of each seat's link and data.
[[nodiscard]] std::string link_html(const LessonScores& lesson);
/// Interventions, marks and audited events in time.
[[nodiscard]] std::string events_html(const Lesson& lesson, const LessonScores& scores);
/// Marks and sheets of evaluators, and their agreement.
[[nodiscard]] std::string evaluators_html(const ScoreResult& result, const LessonScores& lesson);
/// Passed sessions and cumulative sums; empty without thresholds.
[[nodiscard]] std::string progress_html(const ScoreResult& result);

/// How a value stands against a threshold, such as `within the experts' range`.
[[nodiscard]] std::string standing_text(const Threshold& threshold, Metric metric, double value);

}  // namespace tandem::netsim::score
