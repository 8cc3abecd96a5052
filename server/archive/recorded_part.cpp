#include "server/archive/recorded_part.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

#include "common/base/sanitize.h"
#include "common/mcap/mcap_reader.h"
#include "proto/recording/recording_format.h"

namespace tandem::server {
namespace {

constexpr const char* kRepairText = "a file NAME.mcap.part is closed by `tandem-server repair`";

std::string value_of(const mcap::TextMap& map, const char* key) {
  const auto found = map.find(key);
  return found == map.end() ? std::string() : found->second;
}

std::string number_text(unsigned number) { return "part " + std::to_string(number); }

}  // namespace

std::expected<RecordedPart, std::string> read_part(const std::map<std::string, std::string>& session,
                                                   std::string file) {
  RecordedPart part{.file = std::move(file),
                    .session_id = value_of(session, "session_id"),
                    .epoch = value_of(session, "epoch"),
                    .recording = value_of(session, rec::kRecordingKey),
                    .last = {},
                    .previous_file = sanitize(value_of(session, rec::kPreviousKey))};
  if (const std::string text = value_of(session, rec::kPartKey); !part.recording.empty()) {
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), part.number);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size() || part.number < 1 ||
        part.number > RecordedPart::kNumberMax)
      return std::unexpected("has \"" + sanitize(text, 32) + "\" as number of its part (1 to " +
                             std::to_string(RecordedPart::kNumberMax) + "); record the session again");
  }
  return part;
}

std::expected<RecordedPart, std::string> read_part(std::span<const std::byte> bytes, std::string file) {
  const auto reader = mcap::Reader::open(bytes);
  if (!reader) return std::unexpected(reader.error().message);
  const mcap::TextMap* const session = reader->metadata(rec::kSessionRecord);
  if (reader->profile() != rec::kProfile || session == nullptr)
    return std::unexpected("is an MCAP file, but no recording of Tandem");
  auto part = read_part(*session, std::move(file));
  if (const mcap::TextMap* const end = reader->metadata(rec::kPartRecord);
      part && !part->recording.empty() && end != nullptr)
    part->last = value_of(*end, rec::kLastKey) != "false";
  return part;
}

bool same_recording(const RecordedPart& a, const RecordedPart& b) noexcept {
  return !a.recording.empty() && a.recording == b.recording && a.session_id == b.session_id && a.epoch == b.epoch;
}

std::string order_parts(std::vector<RecordedPart>& parts) {
  std::ranges::stable_sort(parts, {}, &RecordedPart::number);
  const auto missing = [](unsigned number, const RecordedPart& beside, const std::string& why) {
    const bool named = beside.number == number + 1 && !beside.previous_file.empty();
    return number_text(number) + " of the recording is missing" + (named ? ", " + beside.previous_file : "") + ": " +
           beside.file + " is " + number_text(beside.number) + why + ". Put all parts into one folder, or name them; " +
           kRepairText;
  };
  const auto twice = std::ranges::adjacent_find(
      parts, [](const RecordedPart& a, const RecordedPart& b) { return a.number == b.number && same_recording(a, b); });
  if (twice != parts.end())
    return twice->file + " and " + std::next(twice)->file + " are both " + number_text(twice->number) +
           " of the recording; name one of them";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const RecordedPart& part = parts[i];
    if (i > 0 && !same_recording(parts[0], part))
      return parts[0].file + " and " + part.file +
             " are no parts of one recording: their session, epoch or recording differ; name the files of one "
             "recording";
    const auto expected = static_cast<unsigned>(i + 1);
    if (part.number != expected) return missing(expected, part, "");
    if (i + 1 < parts.size() && part.last.value_or(false))
      return part.file + " is the last part of the recording, but " + parts[i + 1].file + " is " +
             number_text(parts[i + 1].number) + "; name the files of one recording";
  }
  if (!parts.empty() && !parts.back().last.value_or(true))
    return missing(parts.back().number + 1, parts.back(), ", and says that another one follows");
  return {};
}

}  // namespace tandem::server
