#include "netsim/cells/shipped_cells.h"

#include <array>

namespace tandem::netsim {
namespace {

constexpr auto kCells = sorted_by_name(std::to_array<EmbeddedFile>({
#include "cells_embedded_data.inc"
}));

}  // namespace

std::span<const EmbeddedFile> shipped_cells() noexcept { return kCells; }

const EmbeddedFile* find_shipped_cells(std::string_view name) noexcept { return find_file(kCells, name); }

}  // namespace tandem::netsim
