#include "server/archive/app/recording_scan.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <map>

#include "common/io/output_file.h"

namespace tandem::server {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".mcap";
constexpr const char* kUnfinished = ".mcap.part";

struct FoundFile {
  std::string file;  ///< below the folder
  std::uint64_t bytes = 0;
  std::int64_t modified_ns = 0;
};

struct FoundFiles {
  std::vector<FoundFile> files;
  std::vector<std::string> unfinished;
};

std::expected<FoundFiles, std::string> find_files(const std::string& folder) {
  FoundFiles found;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    const std::string file = it->path().lexically_relative(folder).string();
    struct stat facts{};
    if (::lstat(it->path().c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) continue;
    if (name.ends_with(kUnfinished)) found.unfinished.push_back(file);
    if (!name.ends_with(kExtension)) continue;
    found.files.push_back({file, static_cast<std::uint64_t>(facts.st_size),
                           std::int64_t{facts.st_mtim.tv_sec} * 1'000'000'000 + facts.st_mtim.tv_nsec});
  }
  if (error) return std::unexpected(folder + " cannot be read: " + error.message());
  std::ranges::sort(found.files, {}, &FoundFile::file);
  std::ranges::sort(found.unfinished);
  return found;
}

}  // namespace

std::expected<ScanReport, std::string> scan_recordings(const std::string& folder, RecordingIndex& index,
                                                       const RecordingReader& reader, const ScanProgress& progress) {
  const auto found = find_files(folder);
  if (!found) return std::unexpected(found.error());
  const auto known_rows = index.rows();
  if (!known_rows) return std::unexpected(known_rows.error());
  std::map<std::string, const RecordingRow*> known;
  for (const RecordingRow& row : *known_rows) known.emplace(row.file, &row);

  ScanReport report;
  report.unfinished = found->unfinished;
  std::vector<const FoundFile*> fresh;
  for (const FoundFile& file : found->files) {
    const auto at = known.find(file.file);
    const bool same =
        at != known.end() && at->second->bytes == file.bytes && at->second->modified_ns == file.modified_ns;
    if (at != known.end()) known.erase(at);
    if (!same) fresh.push_back(&file);
  }
  for (const auto& [file, row] : known) {
    if (std::string problem = index.remove(file); !problem.empty()) return std::unexpected(problem);
    ++report.removed;
  }
  for (const FoundFile* const file : fresh) {
    if (!progress(report.added, fresh.size())) {
      report.interrupted = true;
      break;
    }
    RecordingRow row{file->file, file->bytes, file->modified_ns, "", {}};
    if (auto summary = reader(folder + "/" + file->file)) {
      row.summary = std::move(*summary);
    } else {
      row.problem = summary.error().substr(0, summary.error().find('\n'));  // the first of several mistakes
    }
    if (std::string problem = index.put(row); !problem.empty()) return std::unexpected(problem);
    ++report.added;
  }
  return report;
}

}  // namespace tandem::server
