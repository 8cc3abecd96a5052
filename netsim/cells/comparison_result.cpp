#include "netsim/cells/comparison_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tandem::netsim {
namespace {

constexpr CellNumber kJudgedNumbers[] = {CellNumber::kTracking, CellNumber::kStiffness, CellNumber::kDrag,
                                         CellNumber::kEngagedShare};
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Returns whether a cell may win a comparison.
bool competes(const ComparisonResult& c, std::size_t index) {
  return c.results[index] && c.results[index]->sound() && c.of(index, CellNumber::kUnstable).worst == 0;
}

/// Returns whether `best` is better than `own` by more than kClose.
bool clearly_better(const CellNumberRow& row, double best, double own) {
  return row.least_is_worst ? own<(1 - kClose) * best : own>(1 + kClose) * best;
}

}  // namespace

std::size_t ComparisonResult::finished() const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(results, [](const auto& r) { return r.has_value(); }));
}

CellResult::Summary ComparisonResult::of(std::size_t index, CellNumber number) const {
  if (!results[index]) return {kNone, kNone, 0};
  return results[index]->of(number);
}

std::vector<DefaultVerdict> judge_default(const ComparisonResult& c) {
  std::vector<DefaultVerdict> out;
  for (const CellNumber number : kJudgedNumbers) {
    const CellNumberRow& row = row_of(number);
    DefaultVerdict& verdict = out.emplace_back();
    verdict.number = number;
    for (std::size_t own = 0; own < c.cells.size(); ++own) {
      if (!has_default_law(c.cells[own])) continue;
      const double own_value = c.of(own, number).median;
      std::size_t best = own;
      double best_value = kNone;
      for (std::size_t other = 0; other < c.cells.size(); ++other) {
        if (has_default_law(c.cells[other]) || !same_condition(c.cells[own], c.cells[other])) continue;
        const double value = c.of(other, number).median;
        if (std::isnan(value) || !competes(c, other)) continue;
        if (!std::isnan(best_value) && !worse(row, best_value, value)) continue;
        best = other;
        best_value = value;
      }
      if (std::isnan(own_value) || std::isnan(best_value)) continue;
      ++verdict.compared;
      if (clearly_better(row, best_value, own_value)) verdict.exceptions.push_back({own, best, own_value, best_value});
    }
  }
  return out;
}

}  // namespace tandem::netsim
