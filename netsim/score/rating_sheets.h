#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "netsim/score/agreement.h"
#include "netsim/score/lesson_scores.h"

/// Evaluators' sheets of one or several lessons. The scales and their items: server/console/evaluation_sheets.h.
namespace tandem::netsim::score {

/// Total of one sheet.
struct SheetTotal {
  std::string lesson;         ///< file
  std::string scale, of, by;  ///< scale; seat; evaluator
  double total = 0;           ///< of the rated items
  std::size_t rated = 0, items = 0;
  double least = 0, most = 0;  ///< possible totals of all items
  bool closed = false;
  [[nodiscard]] bool complete() const noexcept { return rated == items; }
};

/// Agreement of the evaluators about one scale.
struct ScaleAgreement {
  std::string scale;
  std::vector<std::string> evaluators;
  std::size_t targets = 0;                      ///< seats of lessons that all of them rated; CHECKLIST: items of these
  std::optional<IntraclassCorrelation> totals;  ///< of the totals; not for CHECKLIST
  std::optional<Kappa> kappa;                   ///< CHECKLIST: Cohen's for two evaluators, Fleiss' for more
  std::string missing;                          ///< why a number is missing
};

/// Totals in the order of lessons and sheets. A sheet of an unknown scale is left out and named in `notes`. Of several
/// sheets of one evaluator about one seat with one scale, the last one counts.
[[nodiscard]] std::vector<SheetTotal> sheet_totals(std::span<const LessonScores> lessons,
                                                   std::vector<std::string>& notes);
/// Agreement per scale with at least two evaluators. Only complete sheets count, and only targets that all evaluators
/// of the scale rated.
[[nodiscard]] std::vector<ScaleAgreement> scale_agreements(std::span<const LessonScores> lessons);

}  // namespace tandem::netsim::score
