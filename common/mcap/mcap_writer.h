#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "common/mcap/chunk_compression.h"
#include "common/mcap/data_section.h"
#include "common/mcap/mcap_records.h"

namespace tandem::mcap {

/// Writes an MCAP file piece by piece: the caller appends what `take` returns to a file. Bytes that were taken are
/// whole records, so a file that ends there is readable. One chunk is open at a time; the caller closes it. A chunk has
/// the messages of one channel after those of another, because messages that are alike compress better.
/// Not thread-safe. Functions throw std::bad_alloc only.
class Writer {
 public:
  static constexpr int kLevel = 6;  ///< of zstd

  /// @param profile  meaning of the file, such as "x-tandem"
  /// @param library  name and version of the writing program
  Writer(std::string_view profile, std::string_view library, int level = kLevel);

  /// @return its number, from 1. @pre fewer than kDefinitionsMax schemas so far
  std::uint16_t add_schema(std::string name, std::string encoding, std::string data);
  /// @return its number, from 1. @pre fewer than kDefinitionsMax channels so far; `schema` exists or is 0
  std::uint16_t add_channel(std::string topic, std::uint16_t schema, std::string message_encoding,
                            TextMap metadata = {});
  /// Adds a message to the open chunk.
  /// @param time  at which it was recorded and published [ns]
  void add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time, std::string_view data);
  /// Records of messages in the open chunk [bytes].
  [[nodiscard]] std::size_t open_bytes() const noexcept { return open_bytes_; }
  /// Compresses the open chunk and ends it. Does nothing if it has no message.
  void close_chunk();
  void add_metadata(const Metadata& metadata) { section_.add_metadata(metadata); }
  void add_attachment(const Attachment& attachment) { section_.add_attachment(attachment); }
  /// Closes the open chunk and ends the file. Nothing may follow but `take`.
  void finish();

  /// Returns the whole records since the last call.
  [[nodiscard]] std::string take() { return section_.take(); }
  /// Size of the file without the open chunk [bytes].
  [[nodiscard]] std::uint64_t size() const noexcept { return section_.size(); }
  [[nodiscard]] const Statistics& statistics() const noexcept { return section_.statistics(); }

 private:
  Compressor compressor_;
  DataSection section_;
  std::uint16_t schemas_ = 0, channels_ = 0;
  std::map<std::uint16_t, std::string> open_;  ///< records of the open chunk by channel
  std::size_t open_bytes_ = 0;
  std::string chunk_, compressed_;
  std::map<std::uint16_t, ChunkContent::Places> places_;
  std::uint64_t start_time_ = 0, end_time_ = 0, messages_ = 0;
};

}  // namespace tandem::mcap
