#pragma once

#include <cstddef>
#include <expected>
#include <functional>
#include <string>
#include <vector>

#include "server/archive/app/recording_index.h"

namespace tandem::server {

/// Reads what the index keeps of a file. @return the summary, or why the file is no readable recording
using RecordingReader = std::function<std::expected<RecordingSummary, std::string>(const std::string& path)>;

/// Called before a file is read, with the number of files read so far and in total. Returns false to end the scan.
using ScanProgress = std::function<bool(std::size_t done, std::size_t total)>;

/// Result of a scan.
struct ScanReport {
  std::size_t added = 0, removed = 0;   ///< files new or changed, and files gone since the last scan
  std::vector<std::string> unfinished;  ///< files that are being written, or that a killed server left behind
  bool interrupted = false;
};

/// Brings the index up to date with a folder and its subfolders: reads `*.mcap` files that are new or have changed, and
/// removes rows of files that are gone. A file that cannot be read gets a row with the reason, and is read again only
/// after it has changed. Symbolic links are not followed.
/// @return what was done, or the error of folder or index
[[nodiscard]] std::expected<ScanReport, std::string> scan_recordings(const std::string& folder, RecordingIndex& index,
                                                                     const RecordingReader& reader,
                                                                     const ScanProgress& progress);

}  // namespace tandem::server
