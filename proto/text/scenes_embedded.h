#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tandem {

/// A scene of server/scenes, embedded into the program so that a bare name works in any folder.
struct ShippedScene {
  std::string_view name;     ///< file name without `.textproto`
  std::string_view summary;  ///< the first comment line of the file
  std::string_view text;     ///< the whole file
};

/// All shipped scenes, sorted by name.
[[nodiscard]] std::span<const ShippedScene> shipped_scenes() noexcept;

/// The shipped scene of that name, or null.
[[nodiscard]] const ShippedScene* find_shipped_scene(std::string_view name) noexcept;

}  // namespace tandem
