#pragma once

#include <string>
#include <vector>

#include "server/archive/recording_row.h"

namespace tandem::server {

/// Returns a table for users: file, begin, duration, size, session, persons; then the files that cannot be read. The
/// files of a long recording stand together. Names are shown safely on a terminal.
/// @param whole_folder  the rows are all of the folder, so that missing parts of recordings are named
/// @param unfinished    files NAME.mcap.part of the folder
[[nodiscard]] std::string recordings_text(const std::vector<RecordingRow>& rows, bool whole_folder = true,
                                          const std::vector<std::string>& unfinished = {});
/// Returns all that the index knows of one file, one value per line.
/// @param files    of its recording, in their order; empty or one: it has one
/// @param problem  why they are not the whole recording; empty: they are
[[nodiscard]] std::string recording_text(const RecordingRow& row, const std::vector<std::string>& files = {},
                                         const std::string& problem = {});
/// Returns a JSON array of `{"file", "bytes", "modified_unix_ns", "problem": null or text, "session", "scene",
/// "start_unix_ns": null or number, "duration_s", "rows", "missing_ticks", "complete", "persons": [{"name", "part"}],
/// "recording": null or name, "part": number of the file in it, "last_part": null (not known) or boolean}`, with a line
/// feed.
[[nodiscard]] std::string recordings_json(const std::vector<RecordingRow>& rows);

}  // namespace tandem::server
