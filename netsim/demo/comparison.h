#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

/// Comparison of the paper's numbers with those of Tandem. Pure functions.
namespace tandem::netsim::demo {

/// Range of a number; both ends infinite: no limit.
struct Limit {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool asked() const noexcept { return std::isfinite(least) || std::isfinite(most); }
};

enum class Mark : std::uint8_t { kNone, kMet, kMissed };

struct Cell {
  std::string value;  ///< "1.94"; an en dash if there is no value
  std::string limit;  ///< "≤ 2", "250 ± 2 %"; empty if there is no limit
  Mark mark = Mark::kNone;
};
struct Row {
  std::string label, unit;
  std::string paper;  ///< empty if the paper gives no value
  std::string notes;  ///< letters of the footnotes, "a" or "ac"
  std::array<Cell, kSettings> cells;
};
struct Section {
  std::string title;
  std::vector<Row> rows;
};
struct Comparison {
  std::vector<Section> sections;
  std::vector<std::string> footnotes;  ///< without their letters: a, b, c, ... in order
  std::size_t missed = 0;              ///< cells marked kMissed
};

/// Returns all rows; cells of missing runs contain dashes.
[[nodiscard]] Comparison compare(std::span<const RunResult> runs);

/// Returns the cell of a number with its limit; at most three significant digits.
[[nodiscard]] Cell cell_of(double value, int decimals, const Limit& limit = {});

}  // namespace tandem::netsim::demo
