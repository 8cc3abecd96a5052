#pragma once

#include <expected>
#include <string_view>

#include "proto/spec/cells_spec.h"
#include "proto/spec/input_error.h"

namespace tandem {

/// Parses a file of cells (proto/schema/cells.proto in text format, or JSON if the name ends in `.json`).
/// @param text       whole file, at most 1 MiB
/// @param file_name  used in messages and for the name of the spec
/// @return the grids with every axis filled, or every error found, in file order
[[nodiscard]] std::expected<CellsSpec, InputErrors> parse_cells_text(std::string_view text, std::string_view file_name);

}  // namespace tandem
