#pragma once

#include <string>
#include <vector>

#include "netsim/cells/cell_numbers.h"
#include "netsim/cells/cell_task.h"

namespace tandem::netsim {

/// Result of one seed of a cell.
struct CellRun {
  std::uint64_t seed = 1;
  CellValues values{};
  std::string trouble;              ///< why the session did not run; empty: it ran
  std::vector<std::string> broken;  ///< invariants that the law promises and the run broke
};
/// Results of all seeds of a cell.
struct CellResult {
  std::vector<CellRun> runs;

  /// Median and worst of a number over the seeds that have it; NaN if none has it. For CellNumber::kUnstable both are
  /// the share of seeds.
  struct Summary {
    double median = 0, worst = 0;
    std::uint64_t worst_seed = 0;
  };
  [[nodiscard]] Summary of(CellNumber number) const;
  /// Returns whether every seed ran and broke no invariant that its law promises.
  [[nodiscard]] bool sound() const noexcept;
};

/// Limits of an unstable run: force above 1 Hz [N RMS] in the rest; speed of a hand [m/s] and distance of the tool from
/// the weighted mean of the hands [m] at any time.
inline constexpr double kUnstableForce = 0.2, kUnstableSpeed = 1.5, kUnstableDistance = 0.25;

/// Returns the numbers of a trace. @param times  of its task
[[nodiscard]] CellValues values_of(const FeelTrace& trace, const TaskTimes& times);

/// Runs one seed of a cell.
[[nodiscard]] CellRun measure_cell(const Cell& cell, const CellInput& input, std::uint64_t seed);

/// Encodes the results of a cell as one line of text without line feed; every bit of every number is kept.
[[nodiscard]] std::string to_bytes(const CellResult& result);
/// Decodes them. @throws std::exception if the text is not that of to_bytes.
[[nodiscard]] CellResult cell_result_from_bytes(const std::string& bytes);

}  // namespace tandem::netsim
