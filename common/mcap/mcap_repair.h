#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>

#include "common/mcap/record_parser.h"

namespace tandem::mcap {

/// Result of a repair.
struct RepairResult {
  std::string file;                            ///< a complete file
  bool was_complete = false;                   ///< the input needed no repair; `file` is the input
  std::uint64_t chunks = 0;                    ///< kept
  std::uint64_t messages = 0;                  ///< kept
  std::uint64_t damaged = 0;                   ///< chunks left out
  std::uint64_t lost_bytes = 0;                ///< of the input, behind its last whole record
  std::uint64_t start_time = 0, end_time = 0;  ///< of the messages kept [ns]
};

/// Gives a cut or damaged file a new index and end. It keeps all definitions, metadata, attachments and undamaged
/// chunks byte for byte, and makes message indexes, statistics, summary and footer again from the contents.
/// Messages outside chunks are left out; the writer of this project makes none.
/// Error: the input does not begin as an MCAP file does.
[[nodiscard]] std::expected<RepairResult, ReadError> repair(std::span<const std::byte> file);

}  // namespace tandem::mcap
