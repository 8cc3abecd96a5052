#include "common/mcap/mcap_repair.h"

#include <algorithm>
#include <map>

#include "common/mcap/byte_order.h"
#include "common/mcap/chunk_compression.h"
#include "common/mcap/crc32.h"
#include "common/mcap/data_section.h"
#include "common/mcap/mcap_reader.h"
#include "common/mcap/message_cursor.h"

namespace tandem::mcap {
namespace {

/// Copies one chunk with a new index. @return false if it is damaged
bool copy_chunk(const Chunk& chunk, Decompressor& decompressor, DataSection& out) {
  std::string records;
  if (!decompressor.decompress(chunk.compression, chunk.records, chunk.uncompressed_size, records)) return false;
  if (chunk.crc != 0 && chunk.crc != crc32(bytes_of(records))) return false;
  std::map<std::uint16_t, ChunkContent::Places> places;
  std::uint64_t messages = 0, start = 0, end = 0;
  std::uint64_t at = 0;
  while (const auto record = record_at(bytes_of(records), at)) {
    at = record->end();
    if (record->opcode != Opcode::kMessage) continue;
    const auto message = parse_message(record->content);
    if (!message) return false;
    places[message->channel].emplace_back(message->log_time, record->offset);
    start = messages == 0 ? message->log_time : std::min(start, message->log_time);
    end = messages == 0 ? message->log_time : std::max(end, message->log_time);
    ++messages;
  }
  if (at != records.size()) return false;
  out.add_chunk({.start_time = start,
                 .end_time = end,
                 .messages = messages,
                 .uncompressed_size = records.size(),
                 .crc = crc32(bytes_of(records)),
                 .compression = chunk.compression,
                 .records = text_of(chunk.records),
                 .places = &places});
  return true;
}

}  // namespace

std::expected<RepairResult, ReadError> repair(std::span<const std::byte> file) {
  const auto reader = Reader::open(file);
  if (!reader) return std::unexpected(reader.error());
  RepairResult result;
  MessageCursor cursor{*reader};  // finds definitions inside chunks, too
  while (cursor.next()) ++result.messages;
  if (reader->complete() && cursor.damaged() == 0) {
    result.file = text_of(file);
    result.was_complete = true;
    result.chunks = reader->parts().size();
    if (reader->statistics()) {
      result.start_time = reader->statistics()->start_time;
      result.end_time = reader->statistics()->end_time;
    }
    return result;
  }
  DataSection out{reader->profile(), reader->library()};
  for (const Schema& schema : cursor.schemas()) out.add_schema(schema);
  for (const Channel& channel : cursor.channels()) out.add_channel(channel);
  for (const Metadata& metadata : reader->metadata()) out.add_metadata(metadata);
  for (const Attachment& attachment : reader->attachments()) out.add_attachment(attachment);
  Decompressor decompressor;
  for (const std::uint64_t offset : reader->parts()) {
    const auto record = record_at(file, offset);
    const auto chunk = record && record->opcode == Opcode::kChunk ? parse_chunk(record->content) : std::nullopt;
    if (!chunk || !copy_chunk(*chunk, decompressor, out)) ++result.damaged;
  }
  out.finish();
  result.chunks = out.statistics().chunks;
  result.messages = out.statistics().messages;
  result.start_time = out.statistics().start_time;
  result.end_time = out.statistics().end_time;
  result.lost_bytes = reader->complete() ? 0 : file.size() - reader->data_end();
  result.file = out.take();
  return result;
}

}  // namespace tandem::mcap
