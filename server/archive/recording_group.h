#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/archive/recording_row.h"

namespace tandem::server {

/// The files of one recording.
struct RecordingGroup {
  std::vector<std::size_t> rows;  ///< indices, in the order of the parts; at least one
  std::string problem;            ///< which part is missing; empty: they are the whole recording
};

/// Returns the recordings of a folder, in the order of their first files. Files of one recording lie in one folder. A
/// file that cannot be read, or whose recording has one file, is alone. Copies of a part belong to another recording.
[[nodiscard]] std::vector<RecordingGroup> group_recordings(const std::vector<RecordingRow>& rows);

/// Returns what the index knows of a recording as if it had one file. Its `file` is that of the first row, its
/// `modified_ns` that of the last one. It is complete if every file is and no part is missing.
[[nodiscard]] RecordingRow joined_row(const std::vector<RecordingRow>& rows, const RecordingGroup& group);

/// Returns the indices of all files of the recordings beyond the limits (`beyond_limits`), each recording whole: its
/// age is that of its newest file, its size that of all files.
[[nodiscard]] std::vector<std::size_t> files_beyond_limits(const std::vector<RecordingRow>& rows,
                                                           const RetentionLimits& limits, std::int64_t now_ns);

}  // namespace tandem::server
