#include "netsim/replay/recording_replay.h"

#include <charconv>
#include <string>
#include <utility>

#include "common/base/sanitize.h"
#include "common/mcap/mcap_reader.h"
#include "common/mcap/message_cursor.h"
#include "proto/recording/event_messages.h"
#include "proto/recording/lesson_reader.h"
#include "proto/recording/recording_format.h"
#include "server/recording/input_unpacker.h"

namespace tandem::netsim {
namespace {

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

/// Returns why a recording without inputs has none, and what can be replayed instead.
std::string missing_inputs_text(const Lesson& lesson) {
  const std::string text = "cannot be replayed: it has no inputs (channel " + std::string(rec::kInputsTopic) + "). ";
  const auto program = lesson.metadata.find("program");
  if (program != lesson.metadata.end() && program->second.starts_with("tandem-client record"))
    return text + "`tandem-client record` receives values, not what entered the session: let the server record " +
           "(--record of tandem-server run, key record of serve)";
  constexpr const char* kRest = "Scores, diff, trace, exports, --what-if and hands of it work";
  const std::string begun = lesson.rows() == 0 ? "The recording was begun by an order"
                                               : "The recording was begun by an order at tick " +
                                                     std::to_string(lesson.tick.front()) + " of its session";
  if (const auto why = lesson.metadata.find(rec::kNoInputsKey); why != lesson.metadata.end())
    return text + begun + ", and the server had not kept what entered the session before: " + sanitize(why->second) +
           ". " + kRest;
  if (lesson.rows() > 0 && lesson.tick.front() > 1)
    return text + begun + ", by a server that kept no inputs for it: record the session from its begin. " + kRest;
  return text + "It was made without them";
}

}  // namespace

void RecordingReplayer::begin(const Lesson& lesson) {
  facts_ = std::make_unique<Lesson>();
  facts_->scene = lesson.scene;
  facts_->scene_text = lesson.scene_text;
  out_.session = lesson.session;
  out_.complete = true;
  out_.seats_compared = !lesson.metadata.contains("seats");
  replay_.emplace(facts_->scene);
  if (const auto hash = lesson.metadata.find("scene_hash"); hash != lesson.metadata.end())
    if (const auto bytes = scene_hash_of(hash->second)) replay_->expect_scene(*bytes);
  const auto tools = lesson.metadata.find(rec::kToolsKey);
  rows_.emplace(facts_->scene, out_.seats_compared,
                tools != lesson.metadata.end() && tools->second == rec::kRoundedTools);
  replay_->compare = [this](const server::Session& session) {
    return rows_->compare(session, replay_->counts().ticks);
  };
}

std::expected<void, std::string> RecordingReplayer::add(std::span<const std::byte> file) {
  auto read = read_lesson(file);
  if (!read) return std::unexpected(std::move(read.error()));
  const auto lesson = std::make_shared<const Lesson>(std::move(*read));
  const auto reader = mcap::Reader::open(file);
  if (!reader) return std::unexpected(reader.error().message);
  const bool first = facts_ == nullptr;
  if (first) begin(*lesson);
  if (lesson->scene_text != facts_->scene_text) return std::unexpected("has another scene than the part before");
  if (lesson->rows() > 0 && last_row_ && lesson->tick.front() <= *last_row_)
    return std::unexpected("begins at tick " + std::to_string(lesson->tick.front()) +
                           ", but the part before ends at tick " + std::to_string(*last_row_));
  out_.complete &= lesson->complete;
  if (lesson->rows() > 0) {
    last_row_ = lesson->tick.back();
    out_.length_s = *last_row_ / lesson->scene.tick_hz;
  }
  if (ended()) return {};
  out_.difference = rows_->add(lesson);
  if (!out_.difference && !feed(*reader, *lesson) && first) return std::unexpected(missing_inputs_text(*lesson));
  return {};
}

/// Replays all messages of the inputs. @return whether there are any
bool RecordingReplayer::feed(const mcap::Reader& reader, const Lesson& lesson) {
  mcap::MessageCursor cursor{reader};
  server::InputUnpacker unpacker{lesson};
  bool any = false;
  const auto apply = [&] {
    while (auto event = journal_.next())
      if (!replay_->apply(*event)) return;
  };
  while (const auto message = ended() ? std::nullopt : cursor.next()) {
    const mcap::Channel* const channel = cursor.channel(message->channel);
    if (channel == nullptr || channel->topic != rec::kInputsTopic) continue;
    any = true;
    const auto inputs = rec::decode_inputs(message->data);
    const auto piece = inputs ? unpacker.unpack(inputs->data) : std::nullopt;
    if (piece && journal_.add(*piece)) apply();
    out_.difference = replay_->difference();
    out_.error = rows_->overflowed() ? "the rows of the recording do not follow its inputs: more than " +
                                           std::to_string(RowComparison::kWaitingMax) + " ticks have none"
                 : !replay_->error().empty() ? replay_->error()
                 : !journal_.error().empty() ? journal_.error()
                 : !piece                    ? "a message of " + std::string(rec::kInputsTopic) + " at tick " +
                                std::to_string(message->sequence) + " is damaged"
                          : "";
  }
  return any;
}

RecordingReplay RecordingReplayer::finish() {
  out_.other_builds = replay_->other_builds();
  out_.other_scene = !replay_->same_scene();
  out_.counts = replay_->counts();
  out_.rows = rows_->rows();
  out_.unseen = rows_->unseen();
  // A cut file may lack the inputs of its last rows.
  if (!ended() && out_.complete && last_row_ && rows_->last_tick().value_or(0) < *last_row_)
    out_.error = "the inputs end at tick " + std::to_string(rows_->last_tick().value_or(0)) +
                 " of the session, but the recording goes on to tick " + std::to_string(*last_row_);
  return std::move(out_);
}

std::expected<RecordingReplay, std::string> replay_recording(std::span<const std::byte> file) {
  RecordingReplayer replayer;
  if (auto added = replayer.add(file); !added) return std::unexpected(std::move(added.error()));
  return replayer.finish();
}

}  // namespace tandem::netsim
