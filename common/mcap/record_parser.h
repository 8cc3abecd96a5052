#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/mcap/mcap_records.h"

namespace tandem::mcap {

/// Reason for which a file or a part of it cannot be read.
struct ReadError {
  std::uint64_t offset = 0;  ///< from the start of the file [bytes]
  std::string message;       ///< reason
  /// Returns `FILE: byte OFFSET: message`.
  [[nodiscard]] std::string text(std::string_view file) const;
};

/// A record inside a buffer.
struct Record {
  Opcode opcode = Opcode::kHeader;  ///< may be a number that no enumerator has
  std::uint64_t offset = 0;         ///< of the record in the buffer [bytes]
  std::span<const std::byte> content;
  /// Offset of the byte after the record.
  [[nodiscard]] std::uint64_t end() const noexcept { return offset + kRecordHead + content.size(); }
};

/// Returns the record at `offset`; nullopt if the rest of the buffer does not hold a whole record.
[[nodiscard]] std::optional<Record> record_at(std::span<const std::byte> bytes, std::uint64_t offset) noexcept;

/// A chunk inside a file. Its records are still compressed.
struct Chunk {
  std::uint64_t start_time = 0, end_time = 0, uncompressed_size = 0;
  std::uint32_t crc = 0;  ///< of the decompressed records; 0: unknown
  std::string_view compression;
  std::span<const std::byte> records;
};

/// Parse the content of a record. Further bytes behind the known fields are ignored, as the specification asks.
/// @return nullopt if the content is too short for its fields, or a text is longer than the content
[[nodiscard]] std::optional<Schema> parse_schema(std::span<const std::byte> content);
[[nodiscard]] std::optional<Channel> parse_channel(std::span<const std::byte> content);
[[nodiscard]] std::optional<Message> parse_message(std::span<const std::byte> content) noexcept;
[[nodiscard]] std::optional<Chunk> parse_chunk(std::span<const std::byte> content) noexcept;
[[nodiscard]] std::optional<ChunkIndex> parse_chunk_index(std::span<const std::byte> content);
[[nodiscard]] std::optional<Metadata> parse_metadata(std::span<const std::byte> content);
[[nodiscard]] std::optional<Statistics> parse_statistics(std::span<const std::byte> content);
/// As the others; also nullopt if its CRC does not match.
[[nodiscard]] std::optional<Attachment> parse_attachment(std::span<const std::byte> content);
/// Offset that a metadata index or an attachment index names.
[[nodiscard]] std::optional<std::uint64_t> parse_indexed_offset(std::span<const std::byte> content) noexcept;

}  // namespace tandem::mcap
