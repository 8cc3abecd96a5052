#pragma once

#include <span>
#include <string_view>

#include "proto/text/embedded_file.h"

namespace tandem {

/// All files of server/scenes, sorted by name.
[[nodiscard]] std::span<const EmbeddedFile> shipped_scenes() noexcept;

/// The file of server/scenes with that name, or null.
[[nodiscard]] const EmbeddedFile* find_shipped_scene(std::string_view name) noexcept;

}  // namespace tandem
