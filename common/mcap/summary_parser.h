#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/mcap/mcap_records.h"

namespace tandem::mcap {

/// Contents of the end of a file: where its parts are.
struct Summary {
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::vector<std::uint64_t> metadata_offsets, attachment_offsets;
  std::optional<Statistics> statistics;
  std::uint64_t data_end = 0;  ///< offset of the record that ends the data section
};

/// Reads the summary of a whole file.
/// @return nullopt if the file does not end with a footer, has no summary, or the summary is damaged
[[nodiscard]] std::optional<Summary> parse_summary(std::span<const std::byte> file);

}  // namespace tandem::mcap
