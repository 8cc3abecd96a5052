#pragma once

#include <span>
#include <string_view>

#include "proto/text/embedded_file.h"

namespace tandem::netsim {

/// All files of cells in netsim/cells, sorted by name. They use shipped scenes only.
[[nodiscard]] std::span<const EmbeddedFile> shipped_cells() noexcept;

/// Returns the shipped file of that name, or null.
[[nodiscard]] const EmbeddedFile* find_shipped_cells(std::string_view name) noexcept;

}  // namespace tandem::netsim
