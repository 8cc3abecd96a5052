#include "proto/recording/lesson_reader.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "common/base/csv.h"
#include "common/mcap/mcap_reader.h"
#include "common/mcap/message_cursor.h"
#include "proto/recording/event_messages.h"
#include "proto/recording/lesson_columns.h"
#include "proto/recording/recording_format.h"
#include "proto/recording/tick_messages.h"
#include "proto/text/scene_text.h"

namespace tandem {
namespace {

using namespace rec;

enum class ChannelUse : std::uint8_t {
  kNone,
  kSeat,
  kTool,
  kAuthority,
  kSession,
  kLink,
  kEvent,
  kMark,
  kSheet,
  kCounts
};

constexpr std::uint8_t kGateMax = 6;               // message Seat, `gate`
constexpr std::size_t kBytesPerRow = 16;           // every tick has an entry of this size in the index of every tool
constexpr std::size_t kRowsOfACutChunk = 100'000;  // the index of the last chunk may be missing
constexpr std::size_t kNotesMax = 1'000'000;       // events, marks, sheets or links that are read

}  // namespace

/// Fills a lesson from the messages of a file.
class LessonReader::Builder {
 public:
  Builder(Lesson& lesson, std::size_t rows_max, const LessonSeatSet& without)
      : lesson_(&lesson), rows_left_(rows_max), without_(without), counted_(lesson.counts) {}

  /// @return false if the message is damaged or does not fit the scene
  bool add(const mcap::Message& message, const mcap::Channel& channel) {
    if (message.channel >= uses_.size()) uses_.resize(message.channel + std::size_t{1});
    std::optional<Use>& use = uses_[message.channel];
    if (!use) use = use_of(channel);
    switch (use->what) {
      case ChannelUse::kNone:
        return true;
      case ChannelUse::kSeat:
        return decode(message.data, seat_) && seat_.gate <= kGateMax && seat_.leader <= lesson_->seats.size() &&
               to_row(message, [&] { set_seat(*lesson_, use->index, seat_); });
      case ChannelUse::kTool:
        return decode(message.data, tool_) && to_row(message, [&] { set_tool(*lesson_, use->index, tool_); });
      case ChannelUse::kAuthority:
        return decode(message.data, authority_) && to_row(message, [&] { set_authority(*lesson_, authority_); });
      case ChannelUse::kSession:
        return decode(message.data, session_) && to_row(message, [&] { set_session(*lesson_, session_); });
      case ChannelUse::kLink:
        return add_link(message);
      case ChannelUse::kEvent: {
        auto event = decode_event(message.data);
        if (event) {
          event->tick = message.sequence;
          event->time_ns = since_start(message.log_time);
        }
        return keep(lesson_->events, std::move(event));
      }
      case ChannelUse::kMark:
        return keep(lesson_->marks, decode_mark(message.data));
      case ChannelUse::kSheet:
        return keep(lesson_->sheets, decode_sheet(message.data));
      case ChannelUse::kCounts:
        return add_counts(message);
    }
    return false;
  }

 private:
  struct Use {
    ChannelUse what = ChannelUse::kNone;
    std::size_t index = 0;  ///< of the seat or tool
  };

  [[nodiscard]] Use use_of(const mcap::Channel& channel) const {
    constexpr std::pair<std::string_view, ChannelUse> kTopics[] = {
        {kAuthorityTopic, ChannelUse::kAuthority}, {kSessionTopic, ChannelUse::kSession},
        {kLinkTopic, ChannelUse::kLink},           {kEventsTopic, ChannelUse::kEvent},
        {kMarksTopic, ChannelUse::kMark},          {kSheetsTopic, ChannelUse::kSheet},
        {kCountsTopic, ChannelUse::kCounts}};
    const auto kind = channel.metadata.find(kKindKey);
    if (kind == channel.metadata.end()) return {};
    if (kind->second == kSessionKind) {
      for (const auto& [topic, what] : kTopics)
        if (channel.topic == topic) return {what, 0};
      return {};
    }
    const auto name = channel.metadata.find(kNameKey);
    if (name == channel.metadata.end()) return {};
    if (kind->second == kSeatKind)
      if (const auto index = index_of(lesson_->scene.seats, name->second)) return {ChannelUse::kSeat, *index};
    if (kind->second == kToolKind)
      if (const auto index = index_of(lesson_->scene.tools, name->second)) return {ChannelUse::kTool, *index};
    return {};
  }

  template <class Part>
  static std::optional<std::size_t> index_of(const std::vector<Part>& parts, const std::string& name) {
    const auto found = std::ranges::find(parts, name, &Part::name);
    return found == parts.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - parts.begin()));
  }

  [[nodiscard]] std::int64_t since_start(std::uint64_t log_time) const noexcept {
    return static_cast<std::int64_t>(log_time - static_cast<std::uint64_t>(lesson_->start_unix_ns));
  }

  /// Sets values in the row of the message's tick; a later tick than the last begins a row.
  template <class Set>
  bool to_row(const mcap::Message& message, Set set) {
    const std::uint32_t tick = message.sequence;
    if (lesson_->tick.empty() || tick > lesson_->tick.back()) {
      if (rows_left_ == 0) return false;
      --rows_left_;
      append_row(*lesson_, tick, since_start(message.log_time), without_);
    } else if (tick < lesson_->tick.back()) {
      return false;
    }
    set();
    return true;
  }

  template <class Note>
  static bool keep(std::vector<Note>& notes, std::optional<Note> note) {
    if (!note || notes.size() >= kNotesMax) return false;
    notes.push_back(std::move(*note));
    return true;
  }

  bool add_link(const mcap::Message& message) {
    std::string seat;
    auto link = decode_link(message.data, seat);
    if (!link) return false;
    const auto index = index_of(lesson_->scene.seats, seat);
    if (!index) return false;
    link->tick = message.sequence;
    link->seat = static_cast<std::uint32_t>(*index);
    return keep(lesson_->links, link);
  }

  bool add_counts(const mcap::Message& message) {
    const auto counts = decode_counts(message.data);
    if (!counts) return false;
    if (counts->tools_digest != 0) {
      if (lesson_->digests.size() >= kNotesMax) return false;
      lesson_->digests.push_back({message.sequence, counts->tools_digest});
    }
    for (const CountsMessage::Channel& channel : counts->channels) {
      if (lesson_->counts.size() > mcap::kDefinitionsMax) return false;
      LessonCount count = channel.count;
      if (const auto before = counted_.find(channel.topic); before != counted_.end()) {
        count.recorded += before->second.recorded;
        count.dropped += before->second.dropped;
        count.never_received += before->second.never_received;
      }
      lesson_->counts[channel.topic] = count;
    }
    return true;
  }

  Lesson* lesson_;
  std::size_t rows_left_;  ///< that the file may still have
  LessonSeatSet without_;
  std::map<std::string, LessonCount> counted_;  ///< in the files before
  std::vector<std::optional<Use>> uses_;        ///< by number of the channel
  SeatSample seat_;
  ToolSample tool_;
  AuthoritySample authority_;
  SessionSample session_;
};

namespace {

/// Sets what the metadata records say. @return why this is no recording that can be read; empty: it is
std::string read_metadata(const mcap::Reader& reader, Lesson& lesson) {
  const mcap::TextMap* const session = reader.metadata(kSessionRecord);
  const mcap::TextMap* const scene = reader.metadata(kSceneRecord);
  if (reader.profile() != kProfile || session == nullptr || scene == nullptr)
    return "is an MCAP file, but no recording of Tandem: profile \"" + reader.profile().substr(0, 64) + "\"";
  const auto value = [](const mcap::TextMap& map, const char* key) {
    const auto found = map.find(key);
    return found == map.end() ? std::string() : found->second;
  };
  if (const std::string format = value(*session, "format"); format != kFormat)
    return "has format \"" + format.substr(0, 32) + "\" of recordings; this program reads format " +
           std::string(kFormat) + "; use the version of Tandem that made it (metadata record \"session\")";
  lesson.metadata = *session;
  lesson.session = value(*session, "session");
  const std::string start = value(*session, "start_unix_ns");
  const auto parsed = std::from_chars(start.data(), start.data() + start.size(), lesson.start_unix_ns);
  if (parsed.ec != std::errc{} || parsed.ptr != start.data() + start.size() || lesson.start_unix_ns < 0)
    return "has no valid start_unix_ns: \"" + start.substr(0, 32) + "\"";
  lesson.scene_text = value(*scene, "text");
  auto parsed_scene = parse_scene(lesson.scene_text, value(*scene, "name") + ".textproto");
  if (!parsed_scene) return "has a scene that is not valid: " + to_text(parsed_scene.error());
  lesson.scene = std::move(*parsed_scene);
  // A session that an option shortened ends within a phase, which no scene file can say.
  const std::string duration = value(*scene, "duration_s");
  if (const auto seconds = parse_number(duration); seconds && *seconds > 0) lesson.scene.duration = *seconds;
  lesson.seats.resize(lesson.scene.seats.size());
  lesson.tools.resize(lesson.scene.tools.size());
  if (const mcap::TextMap* const persons = reader.metadata(kParticipantsRecord))
    for (std::size_t i = 0; i < lesson.seats.size(); ++i)
      lesson.seats[i].person = value(*persons, lesson.scene.seats[i].name.c_str());
  const mcap::TextMap* const workstations = reader.metadata(kWorkstationsRecord);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i)
    lesson.seats[i].workstation = workstations == nullptr
                                      ? lesson.seats[i].person == kLoopbackWorkstation
                                      : value(*workstations, lesson.scene.seats[i].name.c_str()) == "true";
  return {};
}

/// Number of rows to take memory for.
std::size_t expected_rows(const mcap::Reader& reader, std::size_t rows_max) {
  if (!reader.statistics()) return 0;
  for (const mcap::Channel& channel : reader.channels())
    if (const auto kind = channel.metadata.find(kKindKey); kind != channel.metadata.end() && kind->second == kToolKind)
      if (const auto count = reader.statistics()->channel_messages.find(channel.id);
          count != reader.statistics()->channel_messages.end())
        return static_cast<std::size_t>(std::min<std::uint64_t>(count->second, rows_max));
  return 0;
}

}  // namespace

std::expected<Lesson, std::string> read_lesson(std::span<const std::byte> bytes, const LessonSeatSet& without) {
  LessonReader reader(without);
  if (auto added = reader.add(bytes); !added) return std::unexpected(std::move(added.error()));
  return reader.take();
}

LessonReader::LessonReader(const LessonSeatSet& without) : without_(without) {}
LessonReader::~LessonReader() = default;

std::expected<void, std::string> LessonReader::begin_file(std::span<const std::byte> definitions,
                                                          std::uint64_t file_bytes) {
  const auto reader = mcap::Reader::open(definitions);
  if (!reader) return std::unexpected(reader.error().message);
  return begin_file(*reader, file_bytes);
}

std::expected<void, std::string> LessonReader::begin_file(const mcap::Reader& definitions, std::uint64_t file_bytes) {
  Lesson facts;
  if (std::string problem = read_metadata(definitions, facts); !problem.empty()) return std::unexpected(problem);
  if (!lesson_) {
    lesson_ = std::move(facts);
  } else if (facts.scene_text != lesson_->scene_text || facts.start_unix_ns != lesson_->start_unix_ns) {
    return std::unexpected("has another scene or begin than the files before, so it is of another session");
  }
  builder_ = std::make_unique<Builder>(*lesson_, file_bytes / kBytesPerRow + kRowsOfACutChunk, without_);
  whole_ = true;
  return {};
}

void LessonReader::add_piece(std::span<const std::byte> piece) {
  if (const auto reader = mcap::Reader::open(piece)) {
    add_messages(*reader);
  } else {
    whole_ = false;
  }
}

void LessonReader::add_messages(const mcap::Reader& reader) {
  mcap::MessageCursor cursor{reader};
  while (const auto message = cursor.next()) {
    const mcap::Channel* const channel = cursor.channel(message->channel);
    whole_ &= channel != nullptr && builder_->add(*message, *channel);
  }
  whole_ &= cursor.damaged() == 0;
}

void LessonReader::end_file(bool complete) {
  lesson_->complete &= whole_ && complete;
  builder_.reset();
}

std::expected<void, std::string> LessonReader::add(std::span<const std::byte> bytes) {
  const auto reader = mcap::Reader::open(bytes);
  if (!reader) return std::unexpected(reader.error().message);
  if (auto begun = begin_file(*reader, bytes.size()); !begun) return begun;
  reserve_rows(*lesson_, lesson_->rows() + expected_rows(*reader, bytes.size() / kBytesPerRow), without_);
  add_messages(*reader);
  end_file(reader->complete() && reader->metadata(kCountsRecord) != nullptr);
  return {};
}

Lesson LessonReader::take_rows(bool last) {
  Lesson out;
  out.session = lesson_->session;
  out.scene = lesson_->scene;
  out.start_unix_ns = lesson_->start_unix_ns;
  out.seats.resize(lesson_->seats.size());
  out.tools.resize(lesson_->tools.size());
  const std::size_t end = lesson_->rows() - (last || lesson_->rows() == 0 ? 0 : 1);
  if (end <= taken_) return out;
  copy_rows(*lesson_, taken_, end - taken_, out);
  // The last row that was taken stays: the next one compares its samples with it.
  erase_rows(*lesson_, end - 1);
  taken_ = 1;
  return out;
}

Lesson LessonReader::take() {
  erase_rows(*lesson_, taken_);
  taken_ = 0;
  return std::move(*lesson_);
}

}  // namespace tandem
