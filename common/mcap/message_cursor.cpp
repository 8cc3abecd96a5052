#include "common/mcap/message_cursor.h"

#include <algorithm>
#include <utility>

#include "common/mcap/byte_order.h"
#include "common/mcap/crc32.h"

namespace tandem::mcap {

MessageCursor::MessageCursor(const Reader& reader, TimeRange range)
    : reader_(&reader), range_(range), schemas_(reader.schemas()), channels_(reader.channels()), by_number_(65'536) {
  for (std::size_t i = 0; i < channels_.size(); ++i) by_number_[channels_[i].id] = static_cast<std::uint32_t>(i + 1);
}

const Channel* MessageCursor::channel(std::uint16_t id) const noexcept {
  return by_number_[id] == 0 ? nullptr : &channels_[by_number_[id] - 1];
}

std::optional<Message> MessageCursor::next() {
  for (;;) {
    if (at_ == places_.size()) {
      if (!open_part()) return std::nullopt;
      order();
      continue;
    }
    const auto record = record_at(bytes_of(records_), places_[at_++].second);
    const auto message = parse_message(record->content);
    if (message && message->log_time >= range_.from && message->log_time <= range_.to) return message;
  }
}

/// Finds the messages of the open part, and takes the definitions between them.
void MessageCursor::order() {
  places_.clear();
  at_ = 0;
  std::uint64_t place = 0;
  while (const auto record = record_at(bytes_of(records_), place)) {
    if (record->opcode != Opcode::kMessage)
      define(*record);
    else if (const auto message = parse_message(record->content))
      places_.emplace_back(message->log_time, place);
    place = record->end();
  }
  // By place too, so that messages of one time keep the order of the file.
  if (!std::ranges::is_sorted(places_)) std::ranges::sort(places_);
}

/// Makes the next chunk's records, or the next message outside a chunk, the open ones. @return false: there is none
bool MessageCursor::open_part() {
  while (part_ < reader_->parts().size()) {
    const std::uint64_t offset = reader_->parts()[part_++];
    const auto record = record_at(reader_->file(), offset);
    if (!record) continue;
    if (record->opcode == Opcode::kMessage) {
      records_.assign(text_of(
          reader_->file().subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(record->end() - offset))));
      if (!parse_message(record->content)) skip(offset, "a message that is too short");
      return true;
    }
    const auto chunk = parse_chunk(record->content);
    if (!chunk) {
      skip(offset, "a chunk that is too short for its fields");
      continue;
    }
    if (chunk->end_time < range_.from || chunk->start_time > range_.to) continue;
    if (auto done = decompressor_.decompress(chunk->compression, chunk->records, chunk->uncompressed_size, records_);
        !done) {
      skip(offset, "a chunk that " + done.error());
      continue;
    }
    if (chunk->crc != 0 && chunk->crc != crc32(bytes_of(records_))) {
      skip(offset, "a chunk whose CRC does not match");
      continue;
    }
    return true;
  }
  records_.clear();
  return false;
}

void MessageCursor::skip(std::uint64_t offset, std::string message) {
  ++damaged_;
  if (!first_damage_) first_damage_ = ReadError{offset, std::move(message)};
  records_.clear();
}

/// Takes a schema or channel that a chunk defines.
void MessageCursor::define(const Record& record) {
  if (record.opcode == Opcode::kChannel) {
    auto channel = parse_channel(record.content);
    if (!channel || by_number_[channel->id] != 0) return;
    channels_.push_back(std::move(*channel));
    by_number_[channels_.back().id] = static_cast<std::uint32_t>(channels_.size());
  } else if (record.opcode == Opcode::kSchema) {
    auto schema = parse_schema(record.content);
    if (schema && std::ranges::find(schemas_, schema->id, &Schema::id) == schemas_.end())
      schemas_.push_back(std::move(*schema));
  }
}

}  // namespace tandem::mcap
