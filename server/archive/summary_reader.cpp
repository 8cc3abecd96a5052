#include "server/archive/summary_reader.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "common/mcap/mcap_reader.h"
#include "common/mcap/message_cursor.h"
#include "proto/recording/event_messages.h"
#include "proto/recording/lesson_reader.h"
#include "proto/recording/recording_format.h"

namespace tandem::server {

namespace {

/// The parts of a lesson that its summary needs: everything but the values of rows.
class SummaryBuilder {
 public:
  explicit SummaryBuilder(Lesson& lesson) : lesson_(&lesson) {}

  /// @param of_tool  the message is of a tool's channel, which has one in every tick
  void add(const mcap::Message& message, const std::string& topic, bool of_tool) {
    if (topic == rec::kMarksTopic) {
      keep(lesson_->marks, rec::decode_mark(message.data));
    } else if (topic == rec::kSheetsTopic) {
      keep(lesson_->sheets, rec::decode_sheet(message.data));
    } else if (of_tool) {
      if (lesson_->tick.empty())  // the time of the first row alone: the begin of the recording
        lesson_->time_ns.push_back(static_cast<std::int64_t>(message.log_time) - lesson_->start_unix_ns);
      if (lesson_->tick.empty() || message.sequence > lesson_->tick.back()) lesson_->tick.push_back(message.sequence);
    }
  }
  /// Whether every message was whole.
  [[nodiscard]] bool whole() const noexcept { return whole_; }

 private:
  template <class Note>
  void keep(std::vector<Note>& notes, std::optional<Note> note) {
    constexpr std::size_t kNotesMax = 1'000'000;
    whole_ = whole_ && note && notes.size() < kNotesMax;
    if (note && notes.size() < kNotesMax) notes.push_back(std::move(*note));
  }

  Lesson* lesson_;
  bool whole_ = true;
};

bool of_tool(const mcap::Channel* channel) {
  if (channel == nullptr) return false;
  const auto kind = channel->metadata.find(rec::kKindKey);
  return kind != channel->metadata.end() && kind->second == rec::kToolKind;
}

/// Adds the persons of every record of participants: a file has several if seats changed hands.
void add_participants(const mcap::Reader& reader, RecordingSummary& summary) {
  for (const mcap::Metadata& record : reader.metadata())
    if (record.name == rec::kParticipantsRecord)
      for (const auto& [seat, person] : record.values) add_person(summary.persons, person, seat);
}

/// Adds the messages of a file. @return whether all of them were whole
bool add_messages(const mcap::Reader& reader, SummaryBuilder& builder) {
  mcap::MessageCursor cursor{reader};
  std::map<std::uint16_t, std::pair<std::string, bool>> topics;
  bool known = true;
  while (const auto message = cursor.next()) {
    auto topic = topics.find(message->channel);
    if (topic == topics.end()) {
      const mcap::Channel* const channel = cursor.channel(message->channel);
      known = known && channel != nullptr;
      topic =
          topics.emplace(message->channel, std::pair{channel == nullptr ? "" : channel->topic, of_tool(channel)}).first;
    }
    builder.add(*message, topic->second.first, topic->second.second);
  }
  return known && cursor.damaged() == 0;
}

}  // namespace

std::expected<RecordingSummary, std::string> read_summary(const RecordingParts& parts, const ReadAt& read) {
  const std::vector<std::byte> definitions = parts.piece(read, 0, 0);
  auto lesson = read_lesson(definitions);  // all metadata, and no row
  if (!lesson) return std::unexpected(lesson.error());
  SummaryBuilder builder(*lesson);
  bool whole = true;
  constexpr std::size_t kTogether = 8;  // chunks
  for (std::size_t i = 0; i < parts.size(); i += kTogether) {
    const std::vector<std::byte> piece = parts.piece(read, i, i + kTogether);
    const auto reader = mcap::Reader::open(piece);
    whole = reader && add_messages(*reader, builder) && whole;
  }
  lesson->complete = whole && builder.whole() && parts.complete();
  RecordingSummary summary = summary_of(*lesson);
  if (const auto reader = mcap::Reader::open(definitions)) add_participants(*reader, summary);
  if (auto part = read_part(definitions, "")) summary.part = std::move(*part);
  return summary;
}

}  // namespace tandem::server
