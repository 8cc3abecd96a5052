#include "common/mcap/data_section.h"

#include <algorithm>

#include "common/mcap/byte_order.h"
#include "common/mcap/crc32.h"

namespace tandem::mcap {
namespace {

void put_texts(std::string& out, const TextMap& map) {
  put_map(out, map, [&](const std::string& key, const std::string& value) {
    put_text(out, key);
    put_text(out, value);
  });
}

void put_schema(std::string& out, const Schema& schema) {
  const std::size_t at = begin_record(out, Opcode::kSchema);
  put(out, schema.id);
  put_text(out, schema.name);
  put_text(out, schema.encoding);
  put_text(out, schema.data);
  end_record(out, at);
}

void put_channel(std::string& out, const Channel& channel) {
  const std::size_t at = begin_record(out, Opcode::kChannel);
  put(out, channel.id);
  put(out, channel.schema_id);
  put_text(out, channel.topic);
  put_text(out, channel.message_encoding);
  put_texts(out, channel.metadata);
  end_record(out, at);
}

void put_chunk_index(std::string& out, const ChunkIndex& chunk) {
  const std::size_t at = begin_record(out, Opcode::kChunkIndex);
  put(out, chunk.start_time);
  put(out, chunk.end_time);
  put(out, chunk.offset);
  put(out, chunk.length);
  put_map(out, chunk.index_offsets, [&](std::uint16_t channel, std::uint64_t offset) {
    put(out, channel);
    put(out, offset);
  });
  put(out, chunk.index_length);
  put_text(out, chunk.compression);
  put(out, chunk.compressed_size);
  put(out, chunk.uncompressed_size);
  end_record(out, at);
}

void put_statistics(std::string& out, const Statistics& statistics) {
  const std::size_t at = begin_record(out, Opcode::kStatistics);
  put(out, statistics.messages);
  put(out, statistics.schemas);
  put(out, statistics.channels);
  put(out, statistics.attachments);
  put(out, statistics.metadata);
  put(out, statistics.chunks);
  put(out, statistics.start_time);
  put(out, statistics.end_time);
  put_map(out, statistics.channel_messages, [&](std::uint16_t channel, std::uint64_t count) {
    put(out, channel);
    put(out, count);
  });
  end_record(out, at);
}

}  // namespace

DataSection::DataSection(std::string_view profile, std::string_view library) {
  out_.append(kMagic);
  const std::size_t at = begin_record(out_, Opcode::kHeader);
  put_text(out_, profile);
  put_text(out_, library);
  end_record(out_, at);
}

void DataSection::add_schema(const Schema& schema) {
  put_schema(out_, schema);
  if (std::ranges::find(schemas_, schema.id, &Schema::id) == schemas_.end()) schemas_.push_back(schema);
}

void DataSection::add_channel(const Channel& channel) {
  put_channel(out_, channel);
  if (std::ranges::find(channels_, channel.id, &Channel::id) == channels_.end()) channels_.push_back(channel);
}

void DataSection::add_chunk(const ChunkContent& chunk) {
  ChunkIndex index;
  index.start_time = chunk.start_time;
  index.end_time = chunk.end_time;
  index.offset = size();
  index.compression = chunk.compression;
  index.compressed_size = chunk.records.size();
  index.uncompressed_size = chunk.uncompressed_size;
  const std::size_t at = begin_record(out_, Opcode::kChunk);
  put(out_, chunk.start_time);
  put(out_, chunk.end_time);
  put(out_, chunk.uncompressed_size);
  put(out_, chunk.crc);
  put_text(out_, chunk.compression);
  put(out_, static_cast<std::uint64_t>(chunk.records.size()));
  out_.append(chunk.records);
  end_record(out_, at);
  index.length = size() - index.offset;
  const std::uint64_t indexes_begin = size();
  for (const auto& [channel, places] : *chunk.places) {
    if (places.empty()) continue;
    index.index_offsets[channel] = size();
    const std::size_t begin = begin_record(out_, Opcode::kMessageIndex);
    put(out_, channel);
    put_map(out_, places, [&](std::uint64_t time, std::uint64_t offset) {
      put(out_, time);
      put(out_, offset);
    });
    end_record(out_, begin);
    statistics_.channel_messages[channel] += places.size();
  }
  index.index_length = size() - indexes_begin;
  const bool first = statistics_.messages == 0;
  if (chunk.messages > 0) {
    statistics_.start_time = first ? chunk.start_time : std::min(statistics_.start_time, chunk.start_time);
    statistics_.end_time = std::max(statistics_.end_time, chunk.end_time);
  }
  statistics_.messages += chunk.messages;
  ++statistics_.chunks;
  if (chunks_.size() == kChunksIndexed) {
    indexed_ = false;
    chunks_ = {};
  }
  if (indexed_) chunks_.push_back(std::move(index));
}

void DataSection::add_metadata(const Metadata& metadata) {
  MetadataIndex index{size(), 0, metadata.name};
  const std::size_t at = begin_record(out_, Opcode::kMetadata);
  put_text(out_, metadata.name);
  put_texts(out_, metadata.values);
  end_record(out_, at);
  index.length = size() - index.offset;
  metadata_.push_back(std::move(index));
  ++statistics_.metadata;
}

void DataSection::add_attachment(const Attachment& attachment) {
  AttachmentIndex index{size(),
                        0,
                        attachment.log_time,
                        attachment.create_time,
                        attachment.data.size(),
                        attachment.name,
                        attachment.media_type};
  const std::size_t at = begin_record(out_, Opcode::kAttachment);
  put(out_, attachment.log_time);
  put(out_, attachment.create_time);
  put_text(out_, attachment.name);
  put_text(out_, attachment.media_type);
  put(out_, static_cast<std::uint64_t>(attachment.data.size()));
  out_.append(attachment.data);
  put(out_, crc32(bytes_of(std::string_view{out_}.substr(at + kRecordHead))));
  end_record(out_, at);
  index.length = size() - index.offset;
  attachments_.push_back(std::move(index));
  ++statistics_.attachments;
}

std::string DataSection::take() {
  crc_ = crc32(bytes_of(out_), crc_);
  taken_ += out_.size();
  return std::exchange(out_, {});
}

template <class Write>
void DataSection::add_group(std::string& out, Opcode opcode, Write write) {
  const std::size_t before = out.size();
  write();
  if (out.size() > before) groups_.push_back({opcode, {size() + before, out.size() - before}});
}

/// Appends summary, summary offsets, footer and magic. They begin at the present end of the file.
void DataSection::summarise(std::string& out) {
  statistics_.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channels = static_cast<std::uint32_t>(channels_.size());
  const std::uint64_t start = size();
  add_group(out, Opcode::kSchema, [&] {
    for (const Schema& schema : schemas_) put_schema(out, schema);
  });
  add_group(out, Opcode::kChannel, [&] {
    for (const Channel& channel : channels_) put_channel(out, channel);
  });
  add_group(out, Opcode::kStatistics, [&] { put_statistics(out, statistics_); });
  add_group(out, Opcode::kChunkIndex, [&] {
    for (const ChunkIndex& chunk : chunks_) put_chunk_index(out, chunk);
  });
  add_group(out, Opcode::kAttachmentIndex, [&] {
    for (const AttachmentIndex& a : attachments_) {
      const std::size_t at = begin_record(out, Opcode::kAttachmentIndex);
      for (const std::uint64_t value : {a.offset, a.length, a.log_time, a.create_time, a.data_size}) put(out, value);
      put_text(out, a.name);
      put_text(out, a.media_type);
      end_record(out, at);
    }
  });
  add_group(out, Opcode::kMetadataIndex, [&] {
    for (const MetadataIndex& m : metadata_) {
      const std::size_t at = begin_record(out, Opcode::kMetadataIndex);
      put(out, m.offset);
      put(out, m.length);
      put_text(out, m.name);
      end_record(out, at);
    }
  });
  const std::uint64_t offsets_start = start + out.size();
  for (const auto& [opcode, range] : groups_) {
    const std::size_t at = begin_record(out, Opcode::kSummaryOffset);
    put(out, static_cast<std::uint8_t>(opcode));
    put(out, range.first);
    put(out, range.second);
    end_record(out, at);
  }
  const std::size_t footer = begin_record(out, Opcode::kFooter);
  put(out, start);
  put(out, offsets_start);
  // The length comes before the CRC, which covers the footer up to itself.
  put(out, std::uint32_t{0});
  end_record(out, footer);
  const std::uint32_t crc = crc32(bytes_of(std::string_view{out}.substr(0, out.size() - sizeof(std::uint32_t))));
  out.resize(out.size() - sizeof crc);
  put(out, crc);
  out.append(kMagic);
}

void DataSection::finish() {
  const std::uint32_t crc = crc32(bytes_of(out_), crc_);
  const std::size_t at = begin_record(out_, Opcode::kDataEnd);
  put(out_, crc);
  end_record(out_, at);
  std::string summary;
  summarise(summary);
  out_.append(summary);
}

}  // namespace tandem::mcap
