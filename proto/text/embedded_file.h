#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tandem {

/// A text file that is embedded into the program, so that its bare name works in any folder.
struct EmbeddedFile {
  std::string_view name;     ///< file name without `.textproto`
  std::string_view summary;  ///< the first comment line of the file; empty if it begins with none
  std::string_view text;     ///< the whole file

  /// Takes the summary from the text.
  constexpr EmbeddedFile(std::string_view file_name, std::string_view whole) noexcept : name(file_name), text(whole) {
    if (!whole.starts_with('#')) return;
    const std::string_view line = whole.substr(0, whole.find('\n'));
    summary = line.substr(std::min(line.find_first_not_of("# "), line.size()));
  }
};

/// Returns the files sorted by name.
template <std::size_t kFiles>
[[nodiscard]] consteval std::array<EmbeddedFile, kFiles> sorted_by_name(std::array<EmbeddedFile, kFiles> files) {
  std::ranges::sort(files, {}, &EmbeddedFile::name);
  return files;
}

/// Returns the file of that name, or null.
[[nodiscard]] constexpr const EmbeddedFile* find_file(std::span<const EmbeddedFile> files,
                                                      std::string_view name) noexcept {
  const auto found = std::ranges::find(files, name, &EmbeddedFile::name);
  return found == files.end() ? nullptr : &*found;
}

}  // namespace tandem
