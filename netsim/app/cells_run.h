#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/io/parallel_jobs.h"
#include "netsim/app/cell_journal.h"
#include "netsim/app/cells_loader.h"
#include "netsim/cells/measure_cell.h"

namespace tandem::netsim {

struct CellsRunOptions {
  std::size_t jobs = 0;            ///< concurrent cells; 0: one per core. No result depends on it
  int stop_fd = -1;                ///< readable: end now
  CellJournal* journal = nullptr;  ///< its results are used, and new ones are appended; null: none
  std::function<void(const io::JobProgress&)> on_progress = {};
};

/// Results of the cells of a file.
struct CellsRun {
  std::vector<std::optional<CellResult>> results;  ///< by index of the cell; empty: it was not run, or it crashed
  std::vector<std::string> troubles;               ///< of crashes, for reports: `cell 3: ...`
  std::string journal_problem;                     ///< why a result could not be kept; empty: all were
  std::size_t taken_over = 0;                      ///< number of results from the journal

  [[nodiscard]] std::size_t finished() const noexcept;
  [[nodiscard]] bool complete() const noexcept { return finished() == results.size(); }
  /// Returns whether all cells are finished and no run broke a promise or could not begin.
  [[nodiscard]] bool good() const noexcept;
};

/// Runs the cells that the journal does not have, in parallel, each in a process of its own. A result that cannot be
/// kept ends the run. @throws std::exception if the journal has a result that cannot be read
[[nodiscard]] CellsRun run_cells(const LoadedCells& loaded, const CellsRunOptions& options);

/// Runs one cell with all its seeds. @param share  receives the share that is done
[[nodiscard]] CellResult run_cell(const LoadedCells& loaded, const Cell& cell,
                                  const std::function<void(double share)>& share = {});

}  // namespace tandem::netsim
