#pragma once

#include <string>
#include <vector>

#include "server/archive/recording_row.h"

namespace tandem::server {

/// Returns a table for users: file, begin, duration, size, session, persons; then the files that cannot be read. Names
/// are shown safely on a terminal.
[[nodiscard]] std::string recordings_text(const std::vector<RecordingRow>& rows);
/// Returns all that the index knows of one recording, one value per line.
[[nodiscard]] std::string recording_text(const RecordingRow& row);
/// Returns a JSON array of `{"file", "bytes", "modified_unix_ns", "problem": null or text, "session", "scene",
/// "start_unix_ns": null or number, "duration_s", "rows", "missing_ticks", "complete", "persons": [{"name", "part"}]}`,
/// with a line feed.
[[nodiscard]] std::string recordings_json(const std::vector<RecordingRow>& rows);

}  // namespace tandem::server
