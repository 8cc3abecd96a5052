#include "netsim/replay/recording_replay.h"

#include <charconv>
#include <string>

#include "common/mcap/mcap_reader.h"
#include "common/mcap/message_cursor.h"
#include "netsim/replay/journal_reader.h"
#include "netsim/replay/record_values.h"
#include "proto/recording/event_messages.h"
#include "proto/recording/lesson_reader.h"
#include "proto/recording/recording_format.h"
#include "server/recording/input_unpacker.h"
#include "server/recording/lesson_record.h"

namespace tandem::netsim {
namespace {

/// Compares the records of a replay with the rows of a lesson.
class RowComparison {
 public:
  /// @param lesson  must outlive this  @param seats  rows have the values of seats as the server knew them
  RowComparison(const Lesson& lesson, bool seats) : lesson_(&lesson), values_(lesson.scene), seats_(seats) {}

  std::optional<ReplayDifference> operator()(const server::Session& session) {
    const server::TickRecord& record = session.record();
    if (!session.recorded() || (last_ ? record.tick <= *last_ : !record.running)) return std::nullopt;
    last_ = record.tick;
    while (row_ < lesson_->rows() && lesson_->tick[row_] < record.tick) ++row_;
    if (row_ >= lesson_->rows() || lesson_->tick[row_] != record.tick) return std::nullopt;  // it was dropped
    server::fill_record(*lesson_, row_, recorded_);
    if (!seats_) {
      recorded_.seats = record.seats;
      for (std::size_t j = 0; j < lesson_->scene.tools.size(); ++j)
        if (lesson_->scene.tools[j].remote) recorded_.tools[j] = record.tools[j];
    }
    ++rows_;
    RecordValues::read(lesson_->scene, recorded_, before_);
    RecordValues::read(lesson_->scene, record, now_);
    return values_.difference(before_, now_);
  }
  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }

 private:
  const Lesson* lesson_;
  RecordValues values_;
  bool seats_;
  std::size_t row_ = 0;
  std::optional<std::uint32_t> last_;  ///< tick of the newest row, as RecordingWriter decides
  std::uint64_t rows_ = 0;
  server::TickRecord recorded_{};
  std::vector<double> before_, now_;
};

/// Hash of a scene from 64 hexadecimal digits; nullopt: it is none.
std::optional<server::Checkpoint::Hash> scene_hash_of(const std::string& hex) {
  server::Checkpoint::Hash hash;
  if (hex.size() != 2 * hash.size()) return std::nullopt;
  for (std::size_t i = 0; i < hash.size(); ++i) {
    std::uint8_t byte = 0;
    const auto parsed = std::from_chars(&hex[2 * i], &hex[2 * i] + 2, byte, 16);
    if (parsed.ec != std::errc{} || parsed.ptr != &hex[2 * i] + 2) return std::nullopt;
    hash[i] = std::byte{byte};
  }
  return hash;
}

/// Feeds all messages of the inputs. @return whether there are any
/// @param damage  set if a message is no block of inputs
bool feed(const mcap::Reader& reader, const Lesson& lesson, SessionReplay& replay, JournalReader& journal,
          std::string& damage) {
  mcap::MessageCursor cursor{reader};
  server::InputUnpacker unpacker{lesson};
  bool any = false, more = true;
  const auto apply = [&] {
    while (auto event = journal.next())
      if (!replay.apply(*event)) return false;
    return journal.error().empty();
  };
  while (const auto message = more ? cursor.next() : std::nullopt) {
    const mcap::Channel* const channel = cursor.channel(message->channel);
    if (channel == nullptr || channel->topic != rec::kInputsTopic) continue;
    any = true;
    const auto inputs = rec::decode_inputs(message->data);
    const auto piece = inputs ? unpacker.unpack(inputs->data) : std::nullopt;
    if (!piece)
      damage = "a message of " + std::string(rec::kInputsTopic) + " at tick " + std::to_string(message->sequence) +
               " is damaged";
    more = piece && journal.add(*piece) && apply();
  }
  return any;
}

/// Returns why a recording without inputs has none, and what can be replayed instead.
std::string missing_inputs_text(const Lesson& lesson) {
  const std::string text = "cannot be replayed: it has no inputs (channel " + std::string(rec::kInputsTopic) + "). ";
  const auto program = lesson.metadata.find("program");
  if (program != lesson.metadata.end() && program->second.starts_with("tandem-client record"))
    return text + "`tandem-client record` receives values, not what entered the session: let the server record " +
           "(--record of tandem-server run, key record of serve)";
  if (lesson.rows() > 0 && lesson.tick.front() > 1)
    return text + "The recording was begun by an order at tick " + std::to_string(lesson.tick.front()) +
           " of its session, and a replay needs all inputs since the first one: record the session from its begin " +
           "(--record without --record-on-order). Scores, diff, trace, exports, --what-if and hands of it work";
  return text + "It was made without them";
}

}  // namespace

std::expected<RecordingReplay, std::string> replay_recording(std::span<const std::byte> file) {
  const auto lesson = read_lesson(file);
  if (!lesson) return std::unexpected(lesson.error());
  const auto reader = mcap::Reader::open(file);
  if (!reader) return std::unexpected(reader.error().message);
  RecordingReplay out;
  out.session = lesson->session;
  out.complete = lesson->complete;
  out.seats_compared = !lesson->metadata.contains("seats");
  if (lesson->rows() > 0) out.length_s = lesson->tick.back() / lesson->scene.tick_hz;
  SessionReplay replay{lesson->scene};
  if (const auto hash = lesson->metadata.find("scene_hash"); hash != lesson->metadata.end())
    if (const auto bytes = scene_hash_of(hash->second)) replay.expect_scene(*bytes);
  RowComparison rows{*lesson, out.seats_compared};
  replay.compare = [&](const server::Session& session) { return rows(session); };
  JournalReader journal;
  std::string damage;
  if (!feed(*reader, *lesson, replay, journal, damage)) return std::unexpected(missing_inputs_text(*lesson));
  out.difference = replay.difference();
  out.error = !replay.error().empty() ? replay.error() : !journal.error().empty() ? journal.error() : damage;
  out.other_builds = replay.other_builds();
  out.other_scene = !replay.same_scene();
  out.counts = replay.counts();
  out.rows = rows.rows();
  return out;
}

}  // namespace tandem::netsim
