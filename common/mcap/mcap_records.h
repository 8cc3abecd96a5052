#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Records of the MCAP container, version 0. Source: https://mcap.dev/spec. All integers are little endian; a record is
/// one byte opcode, eight bytes length, content. Times are nanoseconds since an epoch that the file states.
namespace tandem::mcap {

/// First and last bytes of a file.
inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
inline constexpr std::size_t kRecordHead = 9;                ///< opcode and length [bytes]
inline constexpr std::size_t kFooterContent = 8 + 8 + 4;     ///< [bytes]
inline constexpr std::size_t kDataEndContent = 4;            ///< [bytes]
inline constexpr std::size_t kMessageHead = 2 + 4 + 8 + 8;   ///< fields before the data of a message [bytes]
inline constexpr std::size_t kChunkBytesMax = 256ull << 20;  ///< largest decompressed chunk that is read [bytes]
inline constexpr std::size_t kDefinitionsMax = 65'535;       ///< schemas or channels: their numbers have 16 bits

/// Kind of a record.
enum class Opcode : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kAttachment = 9,
  kAttachmentIndex = 10,
  kStatistics = 11,
  kMetadata = 12,
  kMetadataIndex = 13,
  kSummaryOffset = 14,
  kDataEnd = 15
};

using TextMap = std::map<std::string, std::string>;

struct Schema {
  std::uint16_t id = 0;  ///< from 1; 0: none
  std::string name;      ///< such as the full name of a protobuf message
  std::string encoding;  ///< such as "protobuf": `data` is a serialized FileDescriptorSet
  std::string data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: none
  std::string topic;
  std::string message_encoding;
  TextMap metadata;
};

/// A message inside the file or a decompressed chunk.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;  ///< [ns]
  std::span<const std::byte> data;
};

struct Metadata {
  std::string name;
  TextMap values;
};

struct Attachment {
  std::uint64_t log_time = 0, create_time = 0;  ///< [ns]; create_time 0: not known
  std::string name, media_type;
  std::string data;
};

/// Where a chunk is, from the start of the file [bytes].
struct ChunkIndex {
  std::uint64_t start_time = 0, end_time = 0;            ///< of its messages [ns]; 0 and 0: it has none
  std::uint64_t offset = 0, length = 0;                  ///< of the record
  std::map<std::uint16_t, std::uint64_t> index_offsets;  ///< of the message index of each channel
  std::uint64_t index_length = 0;                        ///< of all message indexes together
  std::string compression;
  std::uint64_t compressed_size = 0, uncompressed_size = 0;
};

struct MetadataIndex {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};

struct AttachmentIndex {
  std::uint64_t offset = 0, length = 0, log_time = 0, create_time = 0, data_size = 0;
  std::string name, media_type;
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
  std::uint64_t start_time = 0, end_time = 0;  ///< [ns]; 0 without messages
  std::map<std::uint16_t, std::uint64_t> channel_messages;
};

}  // namespace tandem::mcap
