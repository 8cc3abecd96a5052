#include "proto/text/scenes_embedded.h"

#include <array>

namespace tandem {
namespace {

constexpr auto kScenes = sorted_by_name(std::to_array<EmbeddedFile>({
#include "scenes_embedded_data.inc"
}));

}  // namespace

std::span<const EmbeddedFile> shipped_scenes() noexcept { return kScenes; }

const EmbeddedFile* find_shipped_scene(std::string_view name) noexcept { return find_file(kScenes, name); }

}  // namespace tandem
