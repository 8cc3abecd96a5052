#include "server/archive/recording_parts.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "common/mcap/mcap_reader.h"
#include "proto/recording/recording_format.h"

namespace tandem::server {

namespace {

using mcap::Opcode;

constexpr std::uint64_t kRecordsMax = 20'000'000;  // a chunk has about twenty records of indexes behind it

bool is_message(Opcode opcode) { return opcode == Opcode::kChunk || opcode == Opcode::kMessage; }
bool is_definition(Opcode opcode) {
  return opcode == Opcode::kHeader || opcode == Opcode::kSchema || opcode == Opcode::kChannel ||
         opcode == Opcode::kMetadata;
}

/// Appends bytes of the file. @return whether all of them could be read
bool append(const ReadAt& read, std::uint64_t offset, std::uint64_t count, std::vector<std::byte>& out) {
  const std::size_t before = out.size();
  out.resize(before + static_cast<std::size_t>(count));
  if (read(offset, std::span(out).subspan(before)) == count) return true;
  out.resize(before);
  return false;
}

}  // namespace

std::expected<RecordingParts, std::string> RecordingParts::find(const ReadAt& read, std::uint64_t file_size) {
  RecordingParts out;
  static_cast<void>(append(read, 0, std::min<std::uint64_t>(mcap::kMagic.size(), file_size), out.head_));
  std::uint64_t at = out.head_.size();
  bool footer = false;
  for (std::uint64_t records = 0; at + mcap::kRecordHead <= file_size; ++records) {
    std::array<std::byte, mcap::kRecordHead> begin{};
    if (records >= kRecordsMax || read(at, begin) != begin.size()) break;
    std::uint64_t content = 0;
    std::memcpy(&content, begin.data() + 1, sizeof content);
    if (content > file_size - at - mcap::kRecordHead) break;  // cut, or damaged from here on
    const auto opcode = static_cast<Opcode>(begin[0]);
    const std::uint64_t bytes = mcap::kRecordHead + content;
    if (is_message(opcode)) {
      if (out.parts_.size() >= kPartsMax) return std::unexpected("has more than 1000000 chunks of messages");
      out.parts_.push_back({at, bytes});
    } else if (opcode == Opcode::kDataEnd) {
      footer = true;
      break;
    } else if (is_definition(opcode)) {
      if (out.head_.size() + out.rest_.size() + bytes > kDefinitionsMax)
        return std::unexpected("has more than 16 MiB of definitions");
      if (!append(read, at, bytes, out.parts_.empty() ? out.head_ : out.rest_)) break;
    }
    at += bytes;
  }
  const auto whole = out.piece(read, 0, 0);
  const auto reader = mcap::Reader::open(whole);
  if (!reader) return std::unexpected(reader.error().message);
  std::array<std::byte, mcap::kMagic.size()> end{};
  footer = footer && file_size >= at + end.size() && read(file_size - end.size(), end) == end.size() &&
           std::memcmp(end.data(), mcap::kMagic.data(), end.size()) == 0;
  out.complete_ = footer && reader->metadata(rec::kCountsRecord) != nullptr;
  return out;
}

std::uint64_t RecordingParts::bytes(std::size_t begin, std::size_t end) const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = begin; i < std::min(end, parts_.size()); ++i) sum += parts_[i].bytes;
  return sum;
}

std::size_t RecordingParts::group_end(std::size_t begin, std::size_t count, std::uint64_t bytes_max) const noexcept {
  std::size_t end = begin + 1;
  while (end < size() && end - begin < count && bytes(begin, end + 1) <= bytes_max) ++end;
  return end;
}

std::vector<std::byte> RecordingParts::piece(const ReadAt& read, std::size_t begin, std::size_t end) const {
  std::vector<std::byte> out;
  out.reserve(head_.size() + rest_.size() + static_cast<std::size_t>(bytes(begin, end)));
  out.insert(out.end(), head_.begin(), head_.end());
  out.insert(out.end(), rest_.begin(), rest_.end());
  for (std::size_t i = begin; i < std::min(end, parts_.size()); ++i)
    static_cast<void>(append(read, parts_[i].offset, parts_[i].bytes, out));
  return out;
}

}  // namespace tandem::server
