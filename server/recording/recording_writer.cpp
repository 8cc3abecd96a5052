#include "server/recording/recording_writer.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "common/base/raw_bytes.h"
#include "proto/recording/event_messages.h"
#include "proto/recording/recording_format.h"
#include "server/recording/build_identity.h"
#include "server/recording/tool_sample.h"

namespace tandem::server {
namespace {

constexpr const char* kClock =
    "log_time = start_unix_ns + nanoseconds of the server's monotonic clock since its first tick; start_unix_ns is the "
    "server's wall clock at that tick, 0 if it has none";

std::string library_text() {
  const BuildIdentity build = build_identity();
  return "tandem " + std::string(build.version) + " (" + std::string(build.commit) + ")";
}

mcap::TextMap session_metadata(const SceneSpec& scene, const RecordingInfo& info) {
  const BuildIdentity build = build_identity();
  mcap::TextMap values{{"version", std::string(build.version)}, {"commit", std::string(build.commit)}};
  for (const auto& [key, value] : info.metadata) values[key] = value;
  values["format"] = rec::kFormat;
  values["session"] = info.session;
  values["start_unix_ns"] = std::to_string(info.start_unix_ns);
  values["clock"] = kClock;
  values["tick_hz"] = std::to_string(scene.tick_hz);
  if (info.round_tools) values[rec::kToolsKey] = rec::kRoundedTools;
  return values;
}

mcap::TextMap scene_metadata(const SceneSpec& scene, const RecordingInfo& info) {
  mcap::TextMap values{{"name", scene.name}, {"text", info.scene_text}};
  if (scene.endless()) return values;
  char digits[32];
  values["duration_s"] = std::string(digits, std::to_chars(digits, digits + sizeof digits, scene.duration).ptr);
  return values;
}

const char* role_text(const SeatSpec& seat) {
  if (seat.kind == SeatKind::kSlave) return "SLAVE";
  switch (seat.role) {
    case Role::kInstructor:
      return "INSTRUCTOR";
    case Role::kTrainee:
      return "TRAINEE";
    case Role::kEvaluator:
      return "EVALUATOR";
    case Role::kObserver:
      return "OBSERVER";
  }
  return "";
}

rec::SeatSample sample_of(const SeatRecord& r) {
  return {.measured_cp = r.x,
          .measured_cv = r.v,
          .measured_cf = r.f_out,
          .servo_cf = r.f_cmd,
          .measured_jp = r.q,
          .sample_tick = r.sample_tick,
          .alpha = r.alpha,
          .gate = static_cast<std::uint8_t>(r.gate),
          .engaged = r.engaged,
          .leader = r.leader,
          .ghost = r.ghost,
          .energy = {r.e_in, r.e_out, r.dissipated_j, r.refused_j, r.margin_min_j, r.delivered_j}};
}

}  // namespace

RecordingWriter::RecordingWriter(const SceneSpec& scene, const RecordingInfo& info)
    : scene_(&scene),
      masters_(scene.masters()),
      start_unix_ns_(info.start_unix_ns),
      file_(rec::kProfile, library_text()),
      channels_(scene, file_),
      notes_(add_note_channels(file_)),
      view_(scene, file_),
      inputs_(scene),
      round_tools_(info.round_tools) {
  file_.add_metadata({rec::kSessionRecord, session_metadata(scene, info)});
  file_.add_metadata({rec::kSceneRecord, scene_metadata(scene, info)});
  mcap::TextMap roles;
  for (const SeatSpec& seat : scene.seats) roles[seat.name] = role_text(seat);
  set_persons(info.persons, info.workstations);
  file_.add_metadata({rec::kRolesRecord, std::move(roles)});
}

void RecordingWriter::set_persons(const std::vector<std::string>& persons, const std::vector<bool>& workstations) {
  mcap::TextMap seats, shared;
  for (std::size_t i = 0; i < std::min(persons.size(), scene_->seats.size()); ++i) {
    seats[scene_->seats[i].name] = persons[i];
    shared[scene_->seats[i].name] = i < workstations.size() && workstations[i] ? "true" : "false";
  }
  file_.add_metadata({rec::kParticipantsRecord, std::move(seats)});
  if (!workstations.empty()) file_.add_metadata({rec::kWorkstationsRecord, std::move(shared)});
}

std::uint64_t RecordingWriter::log_time(std::int64_t time_ns) const noexcept {
  return static_cast<std::uint64_t>(start_unix_ns_ + std::max<std::int64_t>(time_ns, 0));
}

/// Ends the open chunk if a message of this time does not belong to it.
void RecordingWriter::begin_message(std::int64_t time_ns) {
  if (chunk_begin_ && (time_ns - *chunk_begin_ >= kChunkNs || file_.open_bytes() + inputs_.size() >= kChunkBytes))
    flush();
  if (!chunk_begin_) chunk_begin_ = time_ns;
}

void RecordingWriter::add(const TickRecord& record) {
  if (account_.begun() ? record.tick <= account_.last_tick() : !record.running) return;
  if (record.time_ns < time_ns_) flush();  // another session of this server: chunks are in the order of time
  begin_message(record.time_ns);
  content_ = true;
  time_ns_ = record.time_ns;
  account_.add(record.tick);
  inputs_.add_row(record);
  const rec::SessionSample session{record.running, record.stopped_ticks, record.dropped_ticks};
  if (session != session_) {
    encode(session, message_);
    note(notes_.session, message_);
    session_ = session;
  }
  rec::AuthoritySample authority;
  authority.tools = scene_->tools.size();
  authority.masters = masters_;
  for (std::size_t j = 0; j < authority.tools; ++j) authority.alpha[j] = record.tools[j].alpha;
  encode(authority, message_);
  add_if_new(channels_.authority());
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    encode(sample_of(record.seats[i]), message_);
    add_if_new(channels_.seat(i));
  }
  for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
    rec::ToolSample sample = sample_of(record.tools[j]);
    if (round_tools_) round_tool(sample);
    encode(sample, message_);
    add_always(channels_.tool(j));
  }
  if (round_tools_) digest_.add(record, scene_->tools.size());
  view_.add(record, log_time(time_ns_), file_);
}

void RecordingWriter::add_always(TickChannels::Channel& channel) {
  file_.add_message(channel.id, account_.last_tick(), log_time(time_ns_), message_);
  ++channel.recorded;
}

void RecordingWriter::add_if_new(TickChannels::Channel& channel) {
  if (message_ == channel.last) return;
  add_always(channel);
  std::swap(channel.last, message_);
}

void RecordingWriter::note(std::uint16_t channel, std::string_view data) {
  file_.add_message(channel, account_.last_tick(), log_time(time_ns_), data);
}

void RecordingWriter::add_inputs(std::span<const std::byte> piece) {
  begin_message(time_ns_);
  if (inputs_.add(piece)) return;
  write_inputs(true);  // bytes are missing, which the next block's position shows
  static_cast<void>(inputs_.add(piece));
}

void RecordingWriter::add_input_block(std::string_view block) {
  begin_message(time_ns_);
  write_inputs(true);
  write_block(block);
}

/// Adds a block of the inputs so far. @param rest  with a record that is not whole
void RecordingWriter::write_inputs(bool rest) {
  inputs_.take(block_, rest);
  if (!block_.empty()) write_block(block_);
}

void RecordingWriter::write_block(std::string_view block) {
  rec::encode_inputs(account_.last_tick(), bytes_of(block), message_);
  note(notes_.inputs, message_);
}

void RecordingWriter::add_event(const LessonEvent& event) {
  begin_message(event.time_ns);
  const std::uint64_t time = log_time(event.time_ns);
  file_.add_message(notes_.events, event.tick, time, rec::encode_event(event));
  view_.log(rec::LogLevel::kInfo, event.seat, event.what + ": " + event.text, event.tick, time, file_);
}

void RecordingWriter::add_mark(const LessonMark& mark) {
  begin_message(time_ns_);
  content_ = true;
  note(notes_.marks, rec::encode_mark(mark));
  view_.log(rec::LogLevel::kInfo, mark.by, "mark: " + mark.text, account_.last_tick(), log_time(time_ns_), file_);
}

void RecordingWriter::add_sheet(const LessonSheet& sheet) {
  begin_message(time_ns_);
  content_ = true;
  note(notes_.sheets, rec::encode_sheet(sheet));
}

void RecordingWriter::add_link(const LessonLink& link) {
  begin_message(time_ns_);
  file_.add_message(notes_.link, link.tick, log_time(time_ns_), rec::encode_link(link, scene_->seats[link.seat].name));
}

void RecordingWriter::flush() {
  if (!chunk_begin_) return;
  write_inputs(false);
  rec::CountsMessage counts;
  counts.ticks = account_.ticks();
  counts.tools_digest = digest_.take();
  for (const TickChannels::Channel& channel : channels_.all())
    counts.channels.push_back({channel.topic, account_.of(channel.recorded)});
  note(notes_.counts, rec::encode_counts(counts));
  file_.close_chunk();
  chunk_begin_.reset();
  channels_.authority().last.clear();  // each chunk has it, because a damaged one before is skipped
  view_.begin_chunk();
}

void RecordingWriter::finish(bool last) {
  account_.finish();
  if (inputs_.size() > 0) begin_message(time_ns_);
  write_inputs(true);
  flush();
  mcap::TextMap counts{{"ticks", std::to_string(account_.ticks())}};
  for (const TickChannels::Channel& channel : channels_.all()) {
    const LessonCount count = account_.of(channel.recorded);
    counts[channel.topic] = "recorded " + std::to_string(count.recorded) + " dropped " + std::to_string(count.dropped) +
                            " never_received " + std::to_string(count.never_received);
  }
  file_.add_metadata({rec::kCountsRecord, std::move(counts)});
  file_.add_metadata({rec::kPartRecord, {{rec::kLastKey, last ? "true" : "false"}}});
  file_.finish();
}

}  // namespace tandem::server
