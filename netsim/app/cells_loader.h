#pragma once

#include <expected>
#include <string>
#include <vector>

#include "netsim/cells/cell_task.h"
#include "proto/spec/input_error.h"

namespace tandem::netsim {

/// A file of cells with everything that it names.
struct LoadedCells {
  std::string typed;  ///< as typed, for commands
  CellsSpec spec;
  std::vector<Cell> cells;
  CellInput input;
  std::string digest;  ///< of the file, its scene and its recording, 16 hexadecimal digits
};

/// Loads the file of an option --cells: a path, or the bare name of a shipped file. An existing file takes precedence.
/// @return the cells, or all errors: of the text, of names, and pairs of law and coupling that make no sense
[[nodiscard]] std::expected<LoadedCells, InputErrors> load_cells(const std::string& path_or_name);

/// Returns the first 16 hexadecimal digits of the SHA-256 of this program's own file. Results of two programs are
/// comparable if it is equal. Error: why the file cannot be read.
[[nodiscard]] std::expected<std::string, std::string> program_digest();

}  // namespace tandem::netsim
