#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/mcap/mcap_records.h"

namespace tandem::mcap {

/// A chunk ready to be written.
struct ChunkContent {
  /// Time and offset of each message of a channel within the decompressed records.
  using Places = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  std::uint64_t start_time = 0, end_time = 0;  ///< of its messages [ns]
  std::uint64_t messages = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t crc = 0;  ///< of the decompressed records
  std::string_view compression, records;
  const std::map<std::uint16_t, Places>* places = nullptr;  ///< channels without messages have no entry or an empty one
};

/// Appends whole records to a file and remembers what its summary needs. Used by writer and repair.
/// Memory: about 100 bytes per chunk and 10 per chunk and channel, up to kChunksIndexed chunks.
class DataSection {
 public:
  /// Chunks that the summary lists, seven hours at 250 ms. A longer file has no chunk index; readers then scan it.
  static constexpr std::size_t kChunksIndexed = 100'000;

  /// Begins a file: magic and header.
  DataSection(std::string_view profile, std::string_view library);

  void add_schema(const Schema& schema);
  void add_channel(const Channel& channel);
  void add_chunk(const ChunkContent& chunk);
  void add_metadata(const Metadata& metadata);
  void add_attachment(const Attachment& attachment);
  /// Ends the file: data end, summary, summary offsets, footer, magic. Nothing may follow.
  void finish();

  /// Returns the bytes since the last call.
  [[nodiscard]] std::string take();
  /// Size of the file so far [bytes].
  [[nodiscard]] std::uint64_t size() const noexcept { return taken_ + out_.size(); }
  [[nodiscard]] const Statistics& statistics() const noexcept { return statistics_; }

 private:
  void summarise(std::string& out);
  template <class Write>
  void add_group(std::string& out, Opcode opcode, Write write);

  std::string out_;
  std::uint64_t taken_ = 0;
  std::uint32_t crc_ = 0;  ///< of the bytes taken
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  std::vector<AttachmentIndex> attachments_;
  std::vector<std::pair<Opcode, std::pair<std::uint64_t, std::uint64_t>>> groups_;  ///< of the summary: start, length
  bool indexed_ = true;  ///< the summary can list every chunk
  Statistics statistics_;
};

}  // namespace tandem::mcap
