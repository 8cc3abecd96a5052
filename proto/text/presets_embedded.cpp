#include "proto/text/presets_embedded.h"

#include <array>

namespace tandem {
namespace {

constexpr auto kPresets = sorted_by_name(std::to_array<EmbeddedFile>({
#include "presets_embedded_data.inc"
}));

}  // namespace

std::span<const EmbeddedFile> shipped_presets() noexcept { return kPresets; }

const EmbeddedFile* find_shipped_preset(std::string_view name) noexcept { return find_file(kPresets, name); }

}  // namespace tandem
