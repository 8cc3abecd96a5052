#include "proto/text/scene_bytes.h"

#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/text_format.h>

#include <algorithm>

#include "proto/text/scene_convert.h"
#include "proto/text/scene_text.h"
#include "proto/wire/wire_messages.h"

namespace tandem {

namespace {

/// Removes what lies behind the end of a session that was shortened: no reader of scenes accepts it.
void cut_at_end(double end, pb::Scene& scene) {
  auto& timeline = *scene.mutable_timeline();
  timeline.erase(std::remove_if(timeline.begin(), timeline.end(), [&](const auto& step) { return step.at_s() >= end; }),
                 timeline.end());
  auto& phases = *scene.mutable_phase();
  phases.erase(std::remove_if(phases.begin(), phases.end(), [&](const auto& phase) { return phase.from_s() >= end; }),
               phases.end());
  for (auto& phase : phases) phase.set_to_s(std::min(phase.to_s(), end));
}

}  // namespace

std::size_t encode_scene(const SceneSpec& scene, std::span<char> out) {
  pb::Scene message = to_proto(scene);
  cut_at_end(scene.duration, message);
  const std::size_t size = message.ByteSizeLong();
  if (size > out.size() || !message.SerializeToArray(out.data(), static_cast<int>(size))) return 0;
  return size;
}

/// By way of the text, so that the one reader of scene files applies all of its rules.
std::expected<SceneSpec, InputErrors> decode_scene(std::span<const char> bytes, const std::string& name) {
  pb::Scene in;
  const google::protobuf::LogSilencer silence;  // bytes from the network must not flood the log
  std::string text;
  if (bytes.size() > wire::kSetupMax || !in.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())) ||
      !google::protobuf::TextFormat::PrintToString(in, &text)) {
    text::MessageValidator validator(name);
    validator.error_at({}, "", "is not a scene");
    return std::unexpected(validator.take());
  }
  return parse_scene(text, name + ".textproto");
}

std::string scene_file_text(const SceneSpec& scene) {
  pb::Scene out = to_proto(scene);
  if (std::ranges::any_of(scene.phases, [&](const PhaseSpec& phase) { return phase.to > scene.duration; }))
    out.clear_duration_s();
  std::string text;
  google::protobuf::TextFormat::PrintToString(out, &text);
  return text;
}

}  // namespace tandem
