#pragma once

#include <cstddef>
#include <expected>
#include <span>
#include <string>

#include "server/archive/recording_row.h"

namespace tandem::server {

/// Reads what the index keeps of a recording, without its rows: the same as `summary_of(read_lesson(bytes))`, with a
/// thousandth of its memory. Any bytes are safe.
/// @return the summary, or why this is no recording, without the name of the file
[[nodiscard]] std::expected<RecordingSummary, std::string> read_summary(std::span<const std::byte> bytes);

}  // namespace tandem::server
