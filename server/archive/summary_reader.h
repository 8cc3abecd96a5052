#pragma once

#include <expected>
#include <string>

#include "server/archive/recording_parts.h"
#include "server/archive/recording_row.h"

namespace tandem::server {

/// Reads what the index keeps of a recording: the same as `summary_of(read_lesson(bytes))` of its bytes, with the
/// memory of a few chunks and 4 bytes per tick. Any bytes are safe.
/// @return the summary, or why this is no recording, without the name of the file
[[nodiscard]] std::expected<RecordingSummary, std::string> read_summary(const RecordingParts& parts,
                                                                        const ReadAt& read);

}  // namespace tandem::server
