#include "common/mcap/mcap_reader.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "common/mcap/byte_order.h"

namespace tandem::mcap {
namespace {

/// Adds a definition unless one with its number exists: the specification makes both equal.
template <class Definition>
void define(std::vector<Definition>& list, std::optional<Definition> found) {
  if (!found || list.size() >= kDefinitionsMax) return;
  if (std::ranges::find(list, found->id, &Definition::id) == list.end()) list.push_back(std::move(*found));
}

}  // namespace

std::expected<Reader, ReadError> Reader::open(std::span<const std::byte> file) {
  if (file.size() < kMagic.size() || text_of(file.first(kMagic.size())) != kMagic)
    return std::unexpected(ReadError{0, "does not begin with the 8 bytes of an MCAP file"});
  const auto header = record_at(file, kMagic.size());
  if (!header || header->opcode != Opcode::kHeader)
    return std::unexpected(ReadError{kMagic.size(), "has no header record"});
  FieldReader fields{header->content};
  Reader reader{file};
  reader.profile_ = fields.text();
  reader.library_ = fields.text();
  if (!fields.ok()) return std::unexpected(ReadError{kMagic.size(), "has a header record that is too short"});
  const auto summary = parse_summary(file);
  reader.complete_ = summary && reader.use(*summary);
  if (reader.complete_) return reader;
  reader.scan(header->end());
  reader.complete_ = summary && summary->chunks.empty() && reader.data_end_ == summary->data_end;  // has no chunk index
  if (reader.complete_) reader.statistics_ = summary->statistics;
  return reader;
}

const TextMap* Reader::metadata(std::string_view name) const noexcept {
  for (const Metadata& metadata : metadata_ | std::views::reverse)
    if (metadata.name == name) return &metadata.values;
  return nullptr;
}

/// Takes the parts from the summary. @return false, with nothing taken, if one of them is not where it says
bool Reader::use(const Summary& summary) {
  if (!summary.statistics || summary.chunks.size() != summary.statistics->chunks) return false;  // chunks without index
  std::vector<Metadata> metadata;
  std::vector<Attachment> attachments;
  const auto part = [&](std::uint64_t offset, Opcode opcode) -> std::optional<Record> {
    const auto record = record_at(file_, offset);
    return record && record->opcode == opcode && record->end() <= summary.data_end ? record : std::nullopt;
  };
  for (const std::uint64_t offset : summary.metadata_offsets) {
    const auto record = part(offset, Opcode::kMetadata);
    auto found = record ? parse_metadata(record->content) : std::nullopt;
    if (!found) return false;
    metadata.push_back(std::move(*found));
  }
  for (const std::uint64_t offset : summary.attachment_offsets) {
    const auto record = part(offset, Opcode::kAttachment);
    auto found = record ? parse_attachment(record->content) : std::nullopt;
    if (!found) return false;
    attachments.push_back(std::move(*found));
  }
  std::vector<std::uint64_t> parts;
  for (const ChunkIndex& chunk : summary.chunks) {
    if (!part(chunk.offset, Opcode::kChunk)) return false;
    parts.push_back(chunk.offset);
  }
  std::ranges::sort(parts);
  for (const Schema& schema : summary.schemas) define(schemas_, std::optional(schema));
  for (const Channel& channel : summary.channels) define(channels_, std::optional(channel));
  metadata_ = std::move(metadata);
  attachments_ = std::move(attachments);
  parts_ = std::move(parts);
  statistics_ = summary.statistics;
  data_end_ = summary.data_end;
  return true;
}

void Reader::scan(std::uint64_t begin) {
  data_end_ = begin;
  while (const auto record = record_at(file_, data_end_)) {
    switch (record->opcode) {
      case Opcode::kSchema:
        define(schemas_, parse_schema(record->content));
        break;
      case Opcode::kChannel:
        define(channels_, parse_channel(record->content));
        break;
      case Opcode::kChunk:
      case Opcode::kMessage:
        parts_.push_back(record->offset);
        break;
      case Opcode::kMetadata:
        if (auto metadata = parse_metadata(record->content)) metadata_.push_back(std::move(*metadata));
        break;
      case Opcode::kAttachment:
        if (auto attachment = parse_attachment(record->content)) attachments_.push_back(std::move(*attachment));
        break;
      case Opcode::kDataEnd:
      case Opcode::kFooter:
        return;
      default:
        break;  // message indexes, and records of later versions of the format
    }
    data_end_ = record->end();
  }
}

}  // namespace tandem::mcap
