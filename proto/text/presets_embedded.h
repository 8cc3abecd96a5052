#pragma once

#include <span>
#include <string_view>

namespace tandem {

/// A device file of hal/drivers/woodenhaptics/presets, embedded into the program so that a bare name works in any
/// folder.
struct ShippedPreset {
  std::string_view name;     ///< file name without `.textproto`
  std::string_view summary;  ///< the first comment line of the file
  std::string_view text;     ///< the whole file, for parse_device_text
};

/// All shipped presets, sorted by name.
[[nodiscard]] std::span<const ShippedPreset> shipped_presets() noexcept;

/// The shipped preset of that name, or null.
[[nodiscard]] const ShippedPreset* find_shipped_preset(std::string_view name) noexcept;

}  // namespace tandem
