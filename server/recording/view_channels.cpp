#include "server/recording/view_channels.h"

#include <array>
#include <cmath>

#include "proto/recording/message_schema.h"
#include "proto/recording/recording_format.h"
#include "server/recording/recording_channels.h"

namespace tandem::server {
namespace {

using rec::MessageKind;

constexpr std::array<rec::ViewColor, 8> kColors{{{0.12, 0.47, 0.71, 1},
                                                 {1.00, 0.50, 0.05, 1},
                                                 {0.17, 0.63, 0.17, 1},
                                                 {0.84, 0.15, 0.16, 1},
                                                 {0.58, 0.40, 0.74, 1},
                                                 {0.55, 0.34, 0.29, 1},
                                                 {0.89, 0.47, 0.76, 1},
                                                 {0.74, 0.74, 0.13, 1}}};
constexpr rec::ViewColor kToolColor{0.35, 0.35, 0.35, 1}, kWallColor{0.6, 0.6, 0.65, 0.5},
    kTissueColor{0.9, 0.55, 0.55, 0.5};
constexpr double kHandDiameter = 0.012, kToolDiameter = 0.008;  // [m]
constexpr double kBoxSide = 0.2, kBoxThickness = 0.01;          // of surfaces [m]

/// A box whose face is the surface.
rec::ViewBox surface_box(std::string id, int axis, double at, bool from_below, const rec::ViewColor& color) {
  rec::ViewBox box{std::move(id), {}, {kBoxSide, kBoxSide, kBoxSide}, color};
  const auto normal = static_cast<std::size_t>(axis);
  box.size[normal] = kBoxThickness;
  box.center[normal] = at + (from_below ? kBoxThickness / 2 : -kBoxThickness / 2);
  return box;
}

void add_boxes(const std::string& whose, const EnvironmentSpec& environment, std::vector<rec::ViewBox>& boxes) {
  if (const auto& wall = environment.wall)
    boxes.push_back(surface_box(whose + " wall", wall->axis, wall->at, wall->from_below, kWallColor));
  if (const auto& tissue = environment.tissue)
    boxes.push_back(surface_box(whose + " tissue", tissue->axis, tissue->at, tissue->from_below, kTissueColor));
}

}  // namespace

ViewChannels::ViewChannels(const SceneSpec& scene, mcap::Writer& file) : scene_(&scene) {
  const auto schema = [&](MessageKind kind) {
    return file.add_schema(rec::message_name(kind), std::string(rec::kEncoding), rec::message_schema(kind));
  };
  const auto channel = [&](const std::string& topic, std::uint16_t of) {
    return add_recording_channel(file, topic, of, rec::kViewKind);
  };
  scene_channel_ = channel(std::string(rec::kSceneTopic), schema(MessageKind::kSceneUpdate));
  transform_channel_ = channel(std::string(rec::kTransformTopic), schema(MessageKind::kFrameTransform));
  log_channel_ = channel(std::string(rec::kLogTopic), schema(MessageKind::kLog));
  const std::uint16_t pose = schema(MessageKind::kPoseInFrame);
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    seat_channels_.push_back(channel(seat_topic(scene, i) + "/measured_cp", pose));
    add_boxes(scene.seats[i].name, scene.seats[i].environment, boxes_);
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    const std::string topic = tool_topic(scene, j);
    tool_channels_.push_back(channel(topic + "/measured_cp", pose));
    tool_frames_.push_back(topic.substr(1));
    add_boxes(scene.tools[j].name, scene.tools[j].environment, boxes_);
  }
}

void ViewChannels::add(const TickRecord& record, std::uint64_t time, mcap::Writer& file) {
  const auto frame = static_cast<std::int64_t>(record.tick / scene_->tick_hz * kHz);
  if (frame == last_frame_) return;
  last_frame_ = frame;
  bodies_.clear();
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    const SeatRecord& seat = record.seats[i];
    const std::string& name = scene_->seats[i].name;
    bodies_.push_back({"seat " + name, seat.x, seat.f_out, kHandDiameter, kColors[i % kColors.size()], name});
    add_frame(name, seat.x, seat_channels_[i], record.tick, time, file);
  }
  for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
    const ToolRecord& tool = record.tools[j];
    const std::string& name = scene_->tools[j].name;
    bodies_.push_back({"tool " + name, tool.x, tool.f_env, kToolDiameter, kToolColor, name});
    add_frame(tool_frames_[j], tool.x, tool_channels_[j], record.tick, time, file);
  }
  static const std::vector<rec::ViewBox> kNone;
  file.add_message(scene_channel_, record.tick, time,
                   rec::encode_scene_update(time, bodies_, boxes_due_ ? boxes_ : kNone));
  boxes_due_ = false;
}

void ViewChannels::add_frame(const std::string& child, const Triple& position, std::uint16_t channel,
                             std::uint32_t tick, std::uint64_t time, mcap::Writer& file) const {
  if (!std::isfinite(position[0] + position[1] + position[2])) return;
  file.add_message(transform_channel_, tick, time, rec::encode_transform(time, child, position));
  file.add_message(channel, tick, time, rec::encode_pose(time, position));
}

void ViewChannels::log(rec::LogLevel level, const std::string& name, const std::string& text, std::uint32_t tick,
                       std::uint64_t time, mcap::Writer& file) const {
  file.add_message(log_channel_, tick, time, rec::encode_log(time, level, name, text));
}

}  // namespace tandem::server
