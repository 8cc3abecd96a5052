#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

/// The paper's numbers beside ours. Pure.
namespace tandem::netsim::demo {

/// What a number has to stay within; both infinite: nothing is asked.
struct Limit {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool asked() const noexcept { return std::isfinite(least) || std::isfinite(most); }
};

enum class Mark : std::uint8_t { kNone, kMet, kMissed };

struct Cell {
  std::string value;  ///< "1.94"; an en dash when there is none
  std::string limit;  ///< "≤ 2", "250 ± 2 %"; empty when nothing is asked
  Mark mark = Mark::kNone;
};
struct Row {
  std::string label, unit;
  std::string paper;  ///< empty when the paper gives none
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

/// All rows; runs that were not made leave dashes.
[[nodiscard]] Comparison compare(std::span<const RunResult> runs);

/// Cell of a number with its limit; three significant digits at most.
[[nodiscard]] Cell cell_of(double value, int decimals, const Limit& limit = {});

}  // namespace tandem::netsim::demo
