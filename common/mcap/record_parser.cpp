#include "common/mcap/record_parser.h"

#include "common/mcap/byte_order.h"
#include "common/mcap/crc32.h"

namespace tandem::mcap {
namespace {

/// Reads a map whose entries `entry` reads. A map that ends inside an entry makes `fields` fail.
template <class Entry>
bool read_map(FieldReader& fields, Entry entry) {
  FieldReader entries{fields.take(fields.number<std::uint32_t>())};
  while (entries.ok() && !entries.empty()) entry(entries);
  return fields.ok() && entries.ok();
}

bool read_texts(FieldReader& fields, TextMap& map) {
  return read_map(fields, [&](FieldReader& entry) {
    std::string key{entry.text()};
    map[std::move(key)] = entry.text();
  });
}

template <class Value>
std::optional<Value> if_ok(bool ok, Value& value) {
  return ok ? std::optional<Value>(std::move(value)) : std::nullopt;
}

}  // namespace

std::string ReadError::text(std::string_view file) const {
  return std::string(file) + ": byte " + std::to_string(offset) + ": " + message;
}

std::optional<Record> record_at(std::span<const std::byte> bytes, std::uint64_t offset) noexcept {
  if (offset > bytes.size()) return std::nullopt;
  FieldReader fields{bytes.subspan(static_cast<std::size_t>(offset))};
  Record record;
  record.offset = offset;
  record.opcode = static_cast<Opcode>(fields.number<std::uint8_t>());
  record.content = fields.take(fields.number<std::uint64_t>());
  return fields.ok() ? std::optional(record) : std::nullopt;
}

std::optional<Schema> parse_schema(std::span<const std::byte> content) {
  FieldReader fields{content};
  Schema schema;
  schema.id = fields.number<std::uint16_t>();
  schema.name = fields.text();
  schema.encoding = fields.text();
  schema.data = fields.text();
  return if_ok(fields.ok(), schema);
}

std::optional<Channel> parse_channel(std::span<const std::byte> content) {
  FieldReader fields{content};
  Channel channel;
  channel.id = fields.number<std::uint16_t>();
  channel.schema_id = fields.number<std::uint16_t>();
  channel.topic = fields.text();
  channel.message_encoding = fields.text();
  return if_ok(read_texts(fields, channel.metadata), channel);
}

std::optional<Message> parse_message(std::span<const std::byte> content) noexcept {
  FieldReader fields{content};
  Message message;
  message.channel = fields.number<std::uint16_t>();
  message.sequence = fields.number<std::uint32_t>();
  message.log_time = fields.number<std::uint64_t>();
  message.publish_time = fields.number<std::uint64_t>();
  message.data = fields.rest();
  return fields.ok() ? std::optional(message) : std::nullopt;
}

std::optional<Chunk> parse_chunk(std::span<const std::byte> content) noexcept {
  FieldReader fields{content};
  Chunk chunk;
  chunk.start_time = fields.number<std::uint64_t>();
  chunk.end_time = fields.number<std::uint64_t>();
  chunk.uncompressed_size = fields.number<std::uint64_t>();
  chunk.crc = fields.number<std::uint32_t>();
  chunk.compression = fields.text();
  chunk.records = fields.take(fields.number<std::uint64_t>());
  return fields.ok() ? std::optional(chunk) : std::nullopt;
}

std::optional<ChunkIndex> parse_chunk_index(std::span<const std::byte> content) {
  FieldReader fields{content};
  ChunkIndex index;
  index.start_time = fields.number<std::uint64_t>();
  index.end_time = fields.number<std::uint64_t>();
  index.offset = fields.number<std::uint64_t>();
  index.length = fields.number<std::uint64_t>();
  bool ok = read_map(fields, [&](FieldReader& entry) {
    const auto channel = entry.number<std::uint16_t>();
    index.index_offsets[channel] = entry.number<std::uint64_t>();
  });
  index.index_length = fields.number<std::uint64_t>();
  index.compression = fields.text();
  index.compressed_size = fields.number<std::uint64_t>();
  index.uncompressed_size = fields.number<std::uint64_t>();
  ok = ok && fields.ok();
  return if_ok(ok, index);
}

std::optional<Metadata> parse_metadata(std::span<const std::byte> content) {
  FieldReader fields{content};
  Metadata metadata;
  metadata.name = fields.text();
  return if_ok(read_texts(fields, metadata.values), metadata);
}

std::optional<Statistics> parse_statistics(std::span<const std::byte> content) {
  FieldReader fields{content};
  Statistics statistics;
  statistics.messages = fields.number<std::uint64_t>();
  statistics.schemas = fields.number<std::uint16_t>();
  statistics.channels = fields.number<std::uint32_t>();
  statistics.attachments = fields.number<std::uint32_t>();
  statistics.metadata = fields.number<std::uint32_t>();
  statistics.chunks = fields.number<std::uint32_t>();
  statistics.start_time = fields.number<std::uint64_t>();
  statistics.end_time = fields.number<std::uint64_t>();
  const bool ok = read_map(fields, [&](FieldReader& entry) {
    const auto channel = entry.number<std::uint16_t>();
    statistics.channel_messages[channel] = entry.number<std::uint64_t>();
  });
  return if_ok(ok, statistics);
}

std::optional<Attachment> parse_attachment(std::span<const std::byte> content) {
  FieldReader fields{content};
  Attachment attachment;
  attachment.log_time = fields.number<std::uint64_t>();
  attachment.create_time = fields.number<std::uint64_t>();
  attachment.name = fields.text();
  attachment.media_type = fields.text();
  attachment.data = text_of(fields.take(fields.number<std::uint64_t>()));
  const std::size_t covered = content.size() - fields.rest().size();
  const auto crc = fields.number<std::uint32_t>();
  const bool ok = fields.ok() && (crc == 0 || crc == crc32(content.first(covered)));
  return if_ok(ok, attachment);
}

std::optional<std::uint64_t> parse_indexed_offset(std::span<const std::byte> content) noexcept {
  FieldReader fields{content};
  const auto offset = fields.number<std::uint64_t>();
  return fields.ok() ? std::optional(offset) : std::nullopt;
}

}  // namespace tandem::mcap
