#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/mcap/mcap_records.h"
#include "common/mcap/record_parser.h"
#include "common/mcap/summary_parser.h"

namespace tandem::mcap {

/// Finds the parts of an MCAP file in memory: by its summary, or without one by a scan from record to record. Any bytes
/// are safe: every length is checked, and a damaged or cut file gives all whole records before the damage.
/// The file's bytes outlive the reader. MessageCursor (common/mcap/message_cursor.h) reads the messages.
class Reader {
 public:
  /// Error: the bytes do not begin as an MCAP file does, with magic and header.
  [[nodiscard]] static std::expected<Reader, ReadError> open(std::span<const std::byte> file);

  /// The file has an undamaged end, with a summary whose parts are where it says.
  [[nodiscard]] bool complete() const noexcept { return complete_; }
  [[nodiscard]] const std::string& profile() const noexcept { return profile_; }
  [[nodiscard]] const std::string& library() const noexcept { return library_; }
  /// Definitions outside chunks. A file may also define schemas and channels inside chunks; MessageCursor finds those.
  [[nodiscard]] const std::vector<Schema>& schemas() const noexcept { return schemas_; }
  [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return channels_; }
  [[nodiscard]] const std::vector<Metadata>& metadata() const noexcept { return metadata_; }
  /// Returns the values of the last metadata record of this name; nullptr: none.
  [[nodiscard]] const TextMap* metadata(std::string_view name) const noexcept;
  [[nodiscard]] const std::vector<Attachment>& attachments() const noexcept { return attachments_; }
  /// Offsets of the records that hold messages, chunks or messages outside chunks, in the order of the file.
  [[nodiscard]] const std::vector<std::uint64_t>& parts() const noexcept { return parts_; }
  /// Of a complete file.
  [[nodiscard]] const std::optional<Statistics>& statistics() const noexcept { return statistics_; }
  [[nodiscard]] std::span<const std::byte> file() const noexcept { return file_; }
  /// End of the last whole record of the data section [bytes].
  [[nodiscard]] std::uint64_t data_end() const noexcept { return data_end_; }

 private:
  explicit Reader(std::span<const std::byte> file) noexcept : file_(file) {}
  void scan(std::uint64_t begin);
  [[nodiscard]] bool use(const Summary& summary);

  std::span<const std::byte> file_;
  bool complete_ = false;
  std::string profile_, library_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<Metadata> metadata_;
  std::vector<Attachment> attachments_;
  std::vector<std::uint64_t> parts_;
  std::optional<Statistics> statistics_;
  std::uint64_t data_end_ = 0;
};

}  // namespace tandem::mcap
