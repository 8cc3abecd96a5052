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
  places_[channel].emplace_back(time, chunk_.size());
  const std::size_t at = begin_record(chunk_, Opcode::kMessage);
  put(chunk_, channel);
  put(chunk_, sequence);
  put(chunk_, time);
  put(chunk_, time);
  chunk_.append(data);
  end_record(chunk_, at);
  start_time_ = messages_ == 0 ? time : std::min(start_time_, time);
  end_time_ = messages_ == 0 ? time : std::max(end_time_, time);
  ++messages_;
}

void Writer::close_chunk() {
  if (messages_ == 0) return;
  compressor_.compress(chunk_, compressed_);
  section_.add_chunk({.start_time = start_time_,
                      .end_time = end_time_,
                      .messages = messages_,
                      .uncompressed_size = chunk_.size(),
                      .crc = crc32(bytes_of(chunk_)),
                      .compression = kZstd,
                      .records = compressed_,
                      .places = &places_});
  chunk_.clear();
  for (auto& [channel, places] : places_) places.clear();  // keeps their memory for the next chunk
  messages_ = 0;
}

void Writer::finish() {
  close_chunk();
  section_.finish();
}

}  // namespace tandem::mcap
