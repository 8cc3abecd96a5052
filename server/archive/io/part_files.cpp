#include "server/archive/io/part_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "server/archive/io/recording_file.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFolderMax = 100'000;  // files of a folder that are read

std::expected<RecordedPart, std::string> part_of(const std::string& path) {
  const auto file = RecordingFile::open(path);
  if (!file) return std::unexpected(file.error());
  return read_part(file->parts().piece(file->read(), 0, 0), path);
}

/// Returns the paths of the complete recordings in a folder, sorted.
std::expected<std::vector<std::string>, std::string> recordings_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  fs::directory_iterator it(folder, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".mcap") continue;
    if (paths.size() >= kFolderMax)
      return std::unexpected(folder + ": has more than " + std::to_string(kFolderMax) + " recordings; name the files");
    paths.push_back(it->path().string());
  }
  if (error) return std::unexpected(folder + ": cannot be read: " + error.message());
  std::ranges::sort(paths);
  return paths;
}

/// Adds the parts of the recording of `part` that lie in its folder. Files that are no recordings are passed over.
std::string add_neighbours(const RecordedPart& part, std::vector<RecordedPart>& parts) {
  const std::string folder = fs::path(part.file).parent_path().string();
  const auto paths = recordings_in(folder.empty() ? "." : folder);
  if (!paths) return paths.error();
  for (const std::string& path : *paths) {
    std::error_code ignored;
    if (fs::equivalent(path, part.file, ignored)) continue;
    if (auto other = part_of(path); other && same_recording(part, *other)) parts.push_back(std::move(*other));
  }
  return {};
}

/// Returns one part of each recording in a folder.
std::expected<std::vector<RecordedPart>, std::string> recordings_of(const std::string& folder) {
  const auto paths = recordings_in(folder);
  if (!paths) return std::unexpected(paths.error());
  std::vector<RecordedPart> found;
  for (const std::string& path : *paths) {
    auto part = part_of(path);
    if (!part) continue;
    if (std::ranges::none_of(found, [&](const RecordedPart& other) { return same_recording(other, *part); }))
      found.push_back(std::move(*part));
  }
  return found;
}

/// Adds the parts beside the only one that is named, unless it is whole alone.
std::string complete_parts(std::vector<RecordedPart>& parts) {
  const bool whole = parts[0].number == 1 && parts[0].last.value_or(true);
  if (parts.size() == 1 && !parts[0].recording.empty() && !whole) {
    const RecordedPart only = parts[0];
    if (std::string problem = add_neighbours(only, parts); !problem.empty()) return problem;
  }
  return order_parts(parts);
}

bool same_file(const RecordedPart& a, const RecordedPart& b) {
  std::error_code ignored;
  return fs::equivalent(a.file, b.file, ignored);
}

}  // namespace

std::expected<std::vector<RecordedPart>, std::string> find_parts(const std::vector<std::string>& named) {
  std::vector<RecordedPart> parts;
  std::error_code ignored;
  if (named.size() == 1 && fs::is_directory(named[0], ignored)) {
    auto found = recordings_of(named[0]);
    if (!found) return std::unexpected(std::move(found.error()));
    if (found->empty()) return std::unexpected(named[0] + ": has no recording NAME.mcap");
    if (found->size() > 1)
      return std::unexpected(named[0] + ": has " + std::to_string(found->size()) +
                             " recordings; name a file of one, such as " + (*found)[0].file);
    parts = std::move(*found);
  } else {
    for (const std::string& path : named) {
      auto part = part_of(path);
      if (!part) return std::unexpected(path + ": " + part.error());
      parts.push_back(std::move(*part));
    }
  }
  if (std::string problem = complete_parts(parts); !problem.empty()) return std::unexpected(std::move(problem));
  return parts;
}

std::expected<std::vector<std::vector<RecordedPart>>, PartsProblem> find_recordings(
    const std::vector<std::string>& named) {
  std::vector<std::vector<RecordedPart>> recordings;
  for (const std::string& path : named) {
    auto part = part_of(path);
    if (!part) return std::unexpected(PartsProblem{path + ": " + part.error(), false});
    const auto known =
        std::ranges::find_if(recordings, [&](const auto& parts) { return same_recording(parts[0], *part); });
    if (known == recordings.end()) {
      recordings.push_back({std::move(*part)});
    } else if (std::ranges::none_of(*known, [&](const RecordedPart& other) { return same_file(other, *part); })) {
      known->push_back(std::move(*part));
    }
  }
  for (std::vector<RecordedPart>& parts : recordings) {
    std::vector<RecordedPart> all = parts;
    if (all.size() > 1 && order_parts(all).empty()) {
      parts = std::move(all);
      continue;
    }
    parts.resize(1);  // its folder has the rest
    if (std::string problem = complete_parts(parts); !problem.empty())
      return std::unexpected(PartsProblem{std::move(problem), true});
  }
  return recordings;
}

}  // namespace tandem::server
