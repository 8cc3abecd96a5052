#pragma once

#include <string>

namespace tandem::netsim {

/// Arguments of `sweep --cells`.
struct SweepCellsArguments {
  std::string cells;              ///< name of a shipped file, or a path
  std::string resume;             ///< file of finished cells; empty: none
  std::string csv, html, figure;  ///< output files; empty: not wanted
  double cell = 0;                ///< number of the only cell to run; 0: all
  double jobs = 0;                ///< cells at a time; 0: one per core
  bool quiet = false;
};

/// Runs the cells of a file, or one of them, and writes the reports. @return the exit code
[[nodiscard]] int sweep_cells(const SweepCellsArguments& arguments);

/// Prints the shipped files of cells with the number of their cells. @return the exit code
[[nodiscard]] int list_shipped_cells();

}  // namespace tandem::netsim
