#pragma once

#include <span>
#include <string_view>

#include "proto/text/embedded_file.h"

namespace tandem {

/// All files of hal/drivers/woodenhaptics/presets, sorted by name.
[[nodiscard]] std::span<const EmbeddedFile> shipped_presets() noexcept;

/// The file of hal/drivers/woodenhaptics/presets with that name, or null.
[[nodiscard]] const EmbeddedFile* find_shipped_preset(std::string_view name) noexcept;

}  // namespace tandem
