#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/score/experts.h"
#include "netsim/score/lesson_scores.h"
#include "netsim/score/rating_sheets.h"

/// Scores as text, JSON and CSV. No output holds NaN: a value that is absent or withheld has no number, but a reason.
namespace tandem::netsim::score {

/// Everything that one command computed.
struct ScoreResult {
  std::vector<LessonScores> lessons;  ///< in the order of the arguments
  std::size_t experts = 0;            ///< expert recordings
  std::string seat;                   ///< whose scores are compared with the experts'; empty: none
  std::vector<PartThresholds> thresholds;
  std::vector<LearningCurve> curves;
  CusumOptions cusum;
  std::vector<SheetTotal> sheets;
  std::vector<ScaleAgreement> agreements;
  std::vector<std::string> notes;
};

/// Tables for a terminal: per seat one column per part. @param seat  only this seat; empty: all
[[nodiscard]] std::string scores_text(const ScoreResult& result, const std::string& seat);
/// One JSON object. Values are SI.
[[nodiscard]] std::string scores_json(const ScoreResult& result);
/// Rows `file,seat,role,part,metric,unit,value,trust,reason`; commas in texts become semicolons.
[[nodiscard]] std::string scores_csv(const ScoreResult& result);

/// The scores that a reader needs first (main_metrics), for reports: table of the whole lesson per seat, and of the
/// time in which the seat holds the tool, with flags and their reasons.
[[nodiscard]] std::string main_scores_text(const LessonScores& lesson);
/// The same as one JSON object: `conditions`, `notes`, `seats` with parts as in `scores_json`.
[[nodiscard]] std::string main_scores_json(const LessonScores& lesson);

/// `undecided`, `competent` or `deficient`.
[[nodiscard]] std::string_view to_text(Cusum::Verdict verdict) noexcept;
/// Agreement of the evaluators in words, such as `GEARS: ICC(2,1) 0.29 (95 %: 0.02 to 0.76), ...`.
[[nodiscard]] std::string agreement_text(const ScaleAgreement& agreement);

}  // namespace tandem::netsim::score
