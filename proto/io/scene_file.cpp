#include "proto/io/scene_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "common/base/suggestions.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem {
namespace {

constexpr std::size_t kFileMax = 1 << 20;

InputErrors one_error(const std::string& file, std::string message) {
  return {{file, 0, 0, "", "", std::move(message)}};
}

/// Whether text is a CSV table: its first rows have the same number of comma-separated cells and no brace or colon of a
/// scene.
bool is_table(std::string_view text) {
  std::size_t commas = 0;
  for (int rows = 0; rows < 3 && text.find('\n') != std::string_view::npos;) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() + 1);
    if (line.starts_with('#')) continue;
    const auto count = static_cast<std::size_t>(std::ranges::count(line, ','));
    if (count == 0 || line.find_first_of(":{}") != std::string_view::npos || (rows > 0 && count != commas))
      return false;
    commas = count;
    ++rows;
  }
  return commas > 0;
}

/// The first 4096 bytes of a file of any size.
std::string head_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(4096, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

std::expected<std::string, InputErrors> read_text_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return std::unexpected(one_error(path, "is a folder, not a file"));
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return std::unexpected(
        one_error(path, std::string("cannot be read: ") + std::strerror(errno != 0 ? errno : ENOENT)));
  std::string text(kFileMax + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return std::unexpected(one_error(path, "cannot be read"));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kFileMax) return std::unexpected(one_error(path, "is longer than 1 MiB: not a file of this kind"));
  return text;
}

std::expected<SceneSpec, InputErrors> load_scene(const std::string& path_or_name) {
  std::error_code error;
  const bool bare = path_or_name.find_first_of("/.") == std::string::npos;
  const bool is_file = std::filesystem::is_regular_file(path_or_name, error);
  if (bare && !is_file) {
    if (const auto* scene = find_shipped_scene(path_or_name)) {
      return parse_scene(scene->text, std::string(scene->name) + ".textproto");
    }
  }
  if (!std::filesystem::exists(path_or_name, error)) {
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
      return std::unexpected(one_error(path_or_name, "cannot be read: " + error.message()));
    std::vector<std::string> names;
    for (const auto& scene : shipped_scenes()) names.emplace_back(scene.name);
    std::string stem = std::filesystem::path(path_or_name).stem().string();
    return std::unexpected(
        one_error(path_or_name, "no such file, and no shipped scene of this name; " + suggest(stem, names)));
  }
  if (is_table(head_of(path_or_name)))
    return std::unexpected(one_error(path_or_name,
                                     "is a CSV table, not a scene: a scene is text such as `name: \"lesson\"`; "
                                     "`tandem-server scenes` lists those that are shipped"));
  const auto text = read_text_file(path_or_name);
  if (!text) return std::unexpected(text.error());
  return parse_scene(*text, path_or_name);
}

}  // namespace tandem
