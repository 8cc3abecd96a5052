#pragma once

#include <optional>
#include <string>
#include <vector>

#include "netsim/cells/cell.h"
#include "netsim/cells/measure_cell.h"

namespace tandem::netsim {

/// Everything that a report of a sweep over cells shows. Equal values give equal bytes of every report.
struct ComparisonResult {
  std::string typed;  ///< the file of cells as typed, for commands
  CellsSpec spec;
  std::vector<Cell> cells;
  std::vector<std::optional<CellResult>> results;  ///< by index of the cell; empty: not run

  [[nodiscard]] std::size_t finished() const noexcept;
  /// Returns median and worst of a number; NaN if the cell was not run or has no such number.
  [[nodiscard]] CellResult::Summary of(std::size_t index, CellNumber number) const;
};

/// How the default law and coupling do against all others in one number, over all conditions that occur with both.
struct DefaultVerdict {
  struct Exception {
    std::size_t own = 0, best = 0;  ///< indices of cells
    double own_value = 0, best_value = 0;
  };
  CellNumber number{};
  std::size_t compared = 0;           ///< conditions in which the default and at least one stable other have the number
  std::vector<Exception> exceptions;  ///< conditions in which a stable other is more than kClose better
};
/// Share by which the best may be better than the default without being an exception.
inline constexpr double kClose = 0.1;

/// Judges the medians of tracking, stiffness, drag and engaged share. Cells in which a seed was unstable, did not run
/// or broke a promise are no competitors.
[[nodiscard]] std::vector<DefaultVerdict> judge_default(const ComparisonResult& comparison);

/// Returns the results as text for terminals: one row per law and coupling, and the verdict on the default.
[[nodiscard]] std::string comparison_text(const ComparisonResult& comparison);
/// Returns all numbers of one cell as text.
[[nodiscard]] std::string cell_text(const ComparisonResult& comparison, std::size_t index);
/// Returns CSV with one row per cell: the cell, then median, worst and worst seed of each number in SI units, then
/// broken, trouble and the command that repeats it. A number that does not exist is empty.
[[nodiscard]] std::string comparison_csv(const ComparisonResult& comparison);

}  // namespace tandem::netsim
