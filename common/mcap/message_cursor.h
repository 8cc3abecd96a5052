#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/mcap/chunk_compression.h"
#include "common/mcap/mcap_reader.h"

namespace tandem::mcap {

/// Range of times [ns], both ends included.
struct TimeRange {
  std::uint64_t from = 0, to = std::numeric_limits<std::uint64_t>::max();
};

/// Reads the messages of a file: chunk by chunk, within a chunk in the order of their times, and of the file where
/// these are equal. A damaged chunk is skipped as a whole and counted.
class MessageCursor {
 public:
  /// @param reader  outlives the cursor
  /// @param range   messages outside it are skipped, and their chunks are not decompressed
  explicit MessageCursor(const Reader& reader, TimeRange range = {});

  /// Returns the next message, valid until the next call; nullopt at the end.
  [[nodiscard]] std::optional<Message> next();
  /// Returns the channel of a message; nullptr if the file has not defined it.
  [[nodiscard]] const Channel* channel(std::uint16_t id) const noexcept;
  /// Schemas and channels so far, also those inside chunks.
  [[nodiscard]] const std::vector<Schema>& schemas() const noexcept { return schemas_; }
  [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
  /// Chunks that were skipped because they are damaged, and messages outside chunks that are too short.
  [[nodiscard]] std::uint64_t damaged() const noexcept { return damaged_; }
  /// Place and reason of the first of them; empty: none.
  [[nodiscard]] const std::optional<ReadError>& first_damage() const noexcept { return first_damage_; }
  /// Decompressed records of the chunk of the last message.
  [[nodiscard]] std::string_view chunk_records() const noexcept { return records_; }

 private:
  [[nodiscard]] bool open_part();
  void order();
  void skip(std::uint64_t offset, std::string message);
  void define(const Record& record);

  const Reader* reader_;
  TimeRange range_;
  Decompressor decompressor_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<std::uint32_t> by_number_;  ///< place of each channel in `channels_`, plus 1; 0: none
  std::size_t part_ = 0;                  ///< next part of the reader
  std::string records_;                   ///< of the open chunk
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places_;  ///< time and place of its messages
  std::size_t at_ = 0;                                           ///< next of them
  std::uint64_t damaged_ = 0;
  std::optional<ReadError> first_damage_;
};

}  // namespace tandem::mcap
