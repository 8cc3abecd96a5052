#include "common/mcap/mcap_writer.h"

#include <algorithm>
#include <utility>

#include "common/mcap/byte_order.h"
#include "common/mcap/crc32.h"

namespace tandem::mcap {

Writer::Writer(std::string_view profile, std::string_view library, int level)
    : compressor_(level), section_(profile, library) {}

std::uint16_t Writer::add_schema(std::string name, std::string encoding, std::string data) {
  section_.add_schema({++schemas_, std::move(name), std::move(encoding), std::move(data)});
  return schemas_;
}

std::uint16_t Writer::add_channel(std::string topic, std::uint16_t schema, std::string message_encoding,
                                  TextMap metadata) {
  section_.add_channel({++channels_, schema, std::move(topic), std::move(message_encoding), std::move(metadata)});
  return channels_;
}

void Writer::add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time, std::string_view data) {
  std::string& records = open_[channel];
  const std::size_t at = begin_record(records, Opcode::kMessage);
  places_[channel].emplace_back(time, at);
  put(records, channel);
  put(records, sequence);
  put(records, time);
  put(records, time);
  records.append(data);
  end_record(records, at);
  open_bytes_ += records.size() - at;
  start_time_ = messages_ == 0 ? time : std::min(start_time_, time);
  end_time_ = messages_ == 0 ? time : std::max(end_time_, time);
  ++messages_;
}

void Writer::close_chunk() {
  if (messages_ == 0) return;
  chunk_.clear();
  for (auto& [channel, records] : open_) {
    for (auto& place : places_[channel]) place.second += chunk_.size();
    chunk_ += records;
    records.clear();
  }
  open_bytes_ = 0;
  compressor_.compress(chunk_, compressed_);
  section_.add_chunk({.start_time = start_time_,
                      .end_time = end_time_,
                      .messages = messages_,
                      .uncompressed_size = chunk_.size(),
                      .crc = crc32(bytes_of(chunk_)),
                      .compression = kZstd,
                      .records = compressed_,
                      .places = &places_});
  for (auto& [channel, places] : places_) places.clear();  // keeps their memory for the next chunk
  messages_ = 0;
}

void Writer::finish() {
  close_chunk();
  section_.finish();
}

}  // namespace tandem::mcap
