#include "common/mcap/summary_parser.h"

#include "common/mcap/byte_order.h"
#include "common/mcap/crc32.h"
#include "common/mcap/record_parser.h"

namespace tandem::mcap {
namespace {

constexpr std::size_t kFooterBytes = kRecordHead + kFooterContent;
constexpr std::size_t kDataEndBytes = kRecordHead + kDataEndContent;

template <class Value>
bool keep(std::vector<Value>& list, std::optional<Value> value) {
  if (value) list.push_back(std::move(*value));
  return value.has_value();
}

bool read_record(const Record& record, Summary& summary) {
  switch (record.opcode) {
    case Opcode::kSchema:
      return keep(summary.schemas, parse_schema(record.content));
    case Opcode::kChannel:
      return keep(summary.channels, parse_channel(record.content));
    case Opcode::kChunkIndex:
      return keep(summary.chunks, parse_chunk_index(record.content));
    case Opcode::kMetadataIndex:
      return keep(summary.metadata_offsets, parse_indexed_offset(record.content));
    case Opcode::kAttachmentIndex:
      return keep(summary.attachment_offsets, parse_indexed_offset(record.content));
    case Opcode::kStatistics:
      summary.statistics = parse_statistics(record.content);
      return summary.statistics.has_value();
    default:
      return true;  // records of later versions of the format
  }
}

}  // namespace

std::optional<Summary> parse_summary(std::span<const std::byte> file) {
  constexpr std::size_t kTail = kFooterBytes + kMagic.size();
  if (file.size() < kTail + kMagic.size() || text_of(file.last(kMagic.size())) != kMagic) return std::nullopt;
  const auto footer = record_at(file, file.size() - kTail);
  if (!footer || footer->opcode != Opcode::kFooter || footer->content.size() != kFooterContent) return std::nullopt;
  FieldReader fields{footer->content};
  const auto start = fields.number<std::uint64_t>(), offsets = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  if (start < kMagic.size() + kDataEndBytes || start > footer->offset || offsets > footer->offset) return std::nullopt;
  const std::size_t begin = static_cast<std::size_t>(start);
  const auto covered = file.subspan(begin, file.size() - kMagic.size() - sizeof crc - begin);
  if (crc != 0 && crc != crc32(covered)) return std::nullopt;
  Summary summary;
  summary.data_end = start - kDataEndBytes;
  const auto data_end = record_at(file, summary.data_end);
  if (!data_end || data_end->opcode != Opcode::kDataEnd || data_end->end() != start) return std::nullopt;
  std::uint64_t at = start;
  while (at < footer->offset) {
    const auto record = record_at(file, at);
    if (!record || record->end() > footer->offset || !read_record(*record, summary)) return std::nullopt;
    at = record->end();
  }
  return summary;
}

}  // namespace tandem::mcap
