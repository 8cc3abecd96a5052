#include "netsim/app/part_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "common/io/fd.h"
#include "server/archive/recording_parts.h"

namespace tandem::netsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFolderMax = 100'000;  // files of a folder that are read

std::expected<RecordedPart, std::string> part_of(const std::string& path) {
  const io::Fd file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // a pipe must not block
  struct stat facts{};
  if (!file.open() || ::fstat(file.get(), &facts) != 0) return std::unexpected(std::strerror(errno));
  if (!S_ISREG(facts.st_mode)) return std::unexpected("is no file");
  const server::ReadAt read = [&file](std::uint64_t offset, std::span<std::byte> into) {
    std::size_t filled = 0;
    while (filled < into.size()) {
      const ssize_t got =
          ::pread(file.get(), into.data() + filled, into.size() - filled, static_cast<off_t>(offset + filled));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      filled += static_cast<std::size_t>(got);
    }
    return filled;
  };
  const auto size = static_cast<std::uint64_t>(facts.st_size);
  const auto found = server::RecordingParts::find(read, size);
  if (!found) return std::unexpected(found.error());
  return read_part(found->piece(read, 0, 0), path);
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
  const bool whole = parts[0].number == 1 && parts[0].last.value_or(true);
  if (parts.size() == 1 && !parts[0].recording.empty() && !whole) {
    const RecordedPart only = parts[0];
    if (std::string problem = add_neighbours(only, parts); !problem.empty()) return std::unexpected(std::move(problem));
  }
  if (std::string problem = order_parts(parts); !problem.empty()) return std::unexpected(std::move(problem));
  return parts;
}

}  // namespace tandem::netsim
