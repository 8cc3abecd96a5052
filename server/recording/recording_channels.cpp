#include "server/recording/recording_channels.h"

#include <algorithm>
#include <utility>

#include "proto/recording/message_schema.h"
#include "proto/recording/recording_format.h"

namespace tandem::server {
namespace {

using rec::MessageKind;

std::uint16_t add_message_schema(mcap::Writer& file, MessageKind kind) {
  return file.add_schema(rec::message_name(kind), std::string(rec::kEncoding), rec::message_schema(kind));
}

/// Appends an underscore as long as the topic is one of the recording's own.
std::string free_topic(std::string topic) {
  constexpr std::string_view kOwn[] = {rec::kAuthorityTopic,
                                       rec::kSessionTopic,
                                       rec::kInputsTopic,
                                       rec::kLinkTopic,
                                       rec::kEventsTopic,
                                       rec::kMarksTopic,
                                       rec::kSheetsTopic,
                                       rec::kCountsTopic,
                                       rec::kTransformTopic,
                                       rec::kLogTopic,
                                       "/view"};
  if (std::ranges::find(kOwn, topic) != std::end(kOwn)) topic += '_';
  return topic;
}

}  // namespace

std::string seat_topic(const SceneSpec& scene, std::size_t seat) { return free_topic('/' + scene.seats[seat].name); }

std::string tool_topic(const SceneSpec& scene, std::size_t tool) {
  std::string topic = free_topic('/' + scene.tools[tool].name);
  const auto taken = [&] {
    for (std::size_t i = 0; i < scene.seats.size(); ++i)
      if (seat_topic(scene, i) == topic) return true;
    for (std::size_t j = 0; j < tool; ++j)
      if (tool_topic(scene, j) == topic) return true;
    return false;
  };
  while (taken()) topic += '_';  // ends: there are at most 32 topics to differ from
  return topic;
}

std::uint16_t add_recording_channel(mcap::Writer& file, const std::string& topic, std::uint16_t schema,
                                    std::string_view kind, const std::string& name) {
  mcap::TextMap metadata{{rec::kKindKey, std::string(kind)}};
  if (!name.empty()) metadata[rec::kNameKey] = name;
  return file.add_channel(topic, schema, std::string(rec::kEncoding), std::move(metadata));
}

TickChannels::TickChannels(const SceneSpec& scene, mcap::Writer& file) : seats_(scene.seats.size()) {
  const auto add = [&](std::string topic, std::uint16_t schema, std::string_view kind, const std::string& name = {}) {
    const std::uint16_t id = add_recording_channel(file, topic, schema, kind, name);
    channels_.push_back({id, std::move(topic), {}, 0});
  };
  add(std::string(rec::kAuthorityTopic), add_message_schema(file, MessageKind::kAuthority), rec::kSessionKind);
  const std::uint16_t seat = add_message_schema(file, MessageKind::kSeat);
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    add(seat_topic(scene, i), seat, rec::kSeatKind, scene.seats[i].name);
  const std::uint16_t tool = add_message_schema(file, MessageKind::kTool);
  for (std::size_t j = 0; j < scene.tools.size(); ++j)
    add(tool_topic(scene, j), tool, rec::kToolKind, scene.tools[j].name);
}

NoteChannels add_note_channels(mcap::Writer& file) {
  const auto add = [&](std::string_view topic, MessageKind kind) {
    return add_recording_channel(file, std::string(topic), add_message_schema(file, kind), rec::kSessionKind);
  };
  NoteChannels channels;
  channels.session = add(rec::kSessionTopic, MessageKind::kSession);
  channels.inputs = add(rec::kInputsTopic, MessageKind::kInputs);
  channels.link = add(rec::kLinkTopic, MessageKind::kLink);
  channels.events = add(rec::kEventsTopic, MessageKind::kEvent);
  channels.marks = add(rec::kMarksTopic, MessageKind::kMark);
  channels.sheets = add(rec::kSheetsTopic, MessageKind::kSheet);
  channels.counts = add(rec::kCountsTopic, MessageKind::kCounts);
  return channels;
}

void TickAccount::add(std::uint32_t tick) noexcept {
  const std::uint64_t gap = begun() ? tick - last_ - 1 : 0;
  // Records dropped while the session clock stood were of no tick of the session.
  dropped_ += std::min(pending_, gap);
  pending_ = 0;
  ticks_ += gap + 1;
  last_ = tick;
}

void TickAccount::finish() noexcept {
  ticks_ += pending_;
  dropped_ += pending_;
  pending_ = 0;
}

}  // namespace tandem::server
