#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/archive/recording_row.h"

namespace tandem::server {

/// The files of one recording.
struct RecordingGroup {
  std::vector<std::size_t> rows;  ///< indices, in the order of the parts; at least one
  std::string problem;            ///< which part is missing; empty: they are the whole recording so far
  bool grows = false;             ///< the part behind the last one has no end yet
};

/// Returns the recordings of a folder, in the order of their first files. Files of one recording lie in one folder. A
/// file that cannot be read, or whose recording has one file, is alone. Copies of a part belong to another recording.
/// @param unfinished  files NAME.mcap.part, with their folders as in `rows`: such a next part is not missing
[[nodiscard]] std::vector<RecordingGroup> group_recordings(const std::vector<RecordingRow>& rows,
                                                           const std::vector<std::string>& unfinished = {});

/// Returns what the index knows of a recording as if it had one file. Its `file` is that of the first row, its
/// `modified_ns` that of the last one. It is complete if every file is and no part is missing.
[[nodiscard]] RecordingRow joined_row(const std::vector<RecordingRow>& rows, const RecordingGroup& group);

/// Returns the indices of all files of the recordings beyond the limits (`beyond_limits`), each recording whole: it is
/// as old as its begin and as large as all its files. A recording that still grows is neither counted nor chosen.
/// @param unfinished  files NAME.mcap.part, with their folders as in `rows`
[[nodiscard]] std::vector<std::size_t> files_beyond_limits(const std::vector<RecordingRow>& rows,
                                                           const std::vector<std::string>& unfinished,
                                                           const RetentionLimits& limits, std::int64_t now_ns);

/// Returns the chosen files, together those of one recording and the last part first. A deletion that stops within a
/// recording then leaves its begin, which can be read and replayed.
[[nodiscard]] std::vector<std::vector<std::size_t>> deletion_order(const std::vector<RecordingRow>& rows,
                                                                   const std::vector<std::size_t>& chosen);

}  // namespace tandem::server
