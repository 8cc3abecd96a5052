#include "proto/recording/view_messages.h"

#include <cmath>

#include "proto/schema/foxglove.pb.h"

namespace tandem::rec {
namespace {

constexpr double kForceShown = 1e-3;     // [N]
constexpr double kShaftDiameter = 2e-3;  // of arrows [m]

bool all_finite(const Triple& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

void set_time(std::uint64_t time_ns, google::protobuf::Timestamp& out) {
  out.set_seconds(static_cast<std::int64_t>(time_ns / 1'000'000'000));
  out.set_nanos(static_cast<std::int32_t>(time_ns % 1'000'000'000));
}

void set_vector(const Triple& in, foxglove::Vector3& out) {
  out.set_x(in[0]);
  out.set_y(in[1]);
  out.set_z(in[2]);
}

void set_upright(const Triple& position, foxglove::Pose& out) {
  set_vector(position, *out.mutable_position());
  out.mutable_orientation()->set_w(1);
}

void set_color(const ViewColor& in, foxglove::Color& out) {
  out.set_r(in[0]);
  out.set_g(in[1]);
  out.set_b(in[2]);
  out.set_a(in[3]);
}

/// Sets the shortest rotation from +x to the direction of `v`, of length `norm` > 0.
void set_direction(const Triple& v, double norm, foxglove::Quaternion& out) {
  const double x = v[0] / norm, y = v[1] / norm, z = v[2] / norm;
  if (x < -1 + 1e-12) return out.set_z(1);  // half a turn about z
  const double w = std::sqrt((1 + x) / 2);
  out.set_y(-z / (2 * w));
  out.set_z(y / (2 * w));
  out.set_w(w);
}

void add_arrow(const ViewBody& body, foxglove::SceneEntity& entity) {
  const double force = std::hypot(body.force[0], body.force[1], body.force[2]);
  if (!std::isfinite(force) || force < kForceShown) return;
  foxglove::ArrowPrimitive& arrow = *entity.add_arrows();
  set_vector(body.position, *arrow.mutable_pose()->mutable_position());
  set_direction(body.force, force, *arrow.mutable_pose()->mutable_orientation());
  const double length = force * kViewMetresPerNewton, head = std::fmin(length / 3, 3 * kShaftDiameter);
  arrow.set_shaft_length(length - head);
  arrow.set_shaft_diameter(kShaftDiameter);
  arrow.set_head_length(head);
  arrow.set_head_diameter(2.5 * kShaftDiameter);
  set_color(body.color, *arrow.mutable_color());
}

foxglove::SceneEntity& add_entity(std::uint64_t time_ns, const std::string& id, foxglove::SceneUpdate& update) {
  foxglove::SceneEntity& entity = *update.add_entities();
  set_time(time_ns, *entity.mutable_timestamp());
  entity.set_frame_id(kViewFrame);
  entity.set_id(id);
  return entity;
}

}  // namespace

std::string encode_scene_update(std::uint64_t time_ns, const std::vector<ViewBody>& bodies,
                                const std::vector<ViewBox>& boxes) {
  foxglove::SceneUpdate update;
  for (const ViewBody& body : bodies) {
    if (!all_finite(body.position)) continue;
    foxglove::SceneEntity& entity = add_entity(time_ns, body.id, update);
    foxglove::SpherePrimitive& ball = *entity.add_spheres();
    set_upright(body.position, *ball.mutable_pose());
    set_vector({body.diameter, body.diameter, body.diameter}, *ball.mutable_size());
    set_color(body.color, *ball.mutable_color());
    add_arrow(body, entity);
    foxglove::TextPrimitive& label = *entity.add_texts();
    set_upright({body.position[0], body.position[1], body.position[2] + body.diameter}, *label.mutable_pose());
    label.set_billboard(true);
    label.set_font_size(body.diameter);
    set_color(body.color, *label.mutable_color());
    label.set_text(body.label);
  }
  for (const ViewBox& box : boxes) {
    foxglove::CubePrimitive& cube = *add_entity(time_ns, box.id, update).add_cubes();
    set_upright(box.center, *cube.mutable_pose());
    set_vector(box.size, *cube.mutable_size());
    set_color(box.color, *cube.mutable_color());
  }
  return update.SerializeAsString();
}

std::string encode_transform(std::uint64_t time_ns, const std::string& child, const Triple& position) {
  foxglove::FrameTransform transform;
  set_time(time_ns, *transform.mutable_timestamp());
  transform.set_parent_frame_id(kViewFrame);
  transform.set_child_frame_id(child);
  set_vector(position, *transform.mutable_translation());
  transform.mutable_rotation()->set_w(1);
  return transform.SerializeAsString();
}

std::string encode_pose(std::uint64_t time_ns, const Triple& position) {
  foxglove::PoseInFrame pose;
  set_time(time_ns, *pose.mutable_timestamp());
  pose.set_frame_id(kViewFrame);
  set_upright(position, *pose.mutable_pose());
  return pose.SerializeAsString();
}

std::string encode_log(std::uint64_t time_ns, LogLevel level, const std::string& name, const std::string& text) {
  foxglove::Log log;
  set_time(time_ns, *log.mutable_timestamp());
  log.set_level(level == LogLevel::kInfo ? foxglove::Log::INFO : foxglove::Log::WARNING);
  log.set_name(name);
  log.set_message(text);
  return log.SerializeAsString();
}

}  // namespace tandem::rec
