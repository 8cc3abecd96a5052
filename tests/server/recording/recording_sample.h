#pragma once

#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "common/base/raw_bytes.h"
#include "common/base/rng.h"
#include "proto/recording/lesson_reader.h"
#include "proto/text/scene_bytes.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/recording/lesson_record.h"
#include "server/recording/recording_writer.h"

namespace tandem::server::test {

inline SceneSpec shipped_scene(const std::string& name) {
  return *parse_scene(find_shipped_scene(name)->text, name + ".textproto");
}

inline RecordingInfo sample_info(const SceneSpec& scene) {
  return {.session = "lesson 1",
          .scene_text = scene_file_text(scene),
          .metadata = {{"seed", "7"}, {"law", "replica"}},
          .start_unix_ns = 1'700'000'000'000'000'000,
          .persons = {"Ada", "Bo"}};
}

/// A record with numbers of all kinds, also NaN, infinity and -0, in the seats and tools of the scene.
inline TickRecord any_record(const SceneSpec& scene, std::uint32_t tick, RandomStream& random) {
  const auto any = [&] {
    constexpr double kSpecial[] = {0.0, -0.0, std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(), 1e-310};
    return random.below(4) == 0 ? kSpecial[random.below(5)] : std::bit_cast<double>(random.bits());
  };
  const auto fill = [&](auto& values) {
    for (double& value : values) value = any();
  };
  TickRecord r;
  r.tick = tick;
  r.time_ns = std::int64_t{tick} * 1'000'000;
  r.running = random.below(10) != 0;
  r.stopped_ticks = random.below(3);
  r.dropped_ticks = random.below(3);
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    SeatRecord& s = r.seats[i];
    for (auto* v : {&s.x, &s.v, &s.f_cmd, &s.f_out, &s.ghost}) fill(*v);
    fill(s.q);
    for (double* value : {&s.alpha, &s.dissipated_j, &s.refused_j, &s.margin_min_j, &s.delivered_j}) *value = any();
    for (auto* e : {&s.e_in, &s.e_out})
      for (std::uint64_t& axis : *e) axis = random.bits();
    s.leader = static_cast<std::uint32_t>(random.below(scene.seats.size() + 1));
    s.gate = static_cast<wire::GateState>(random.below(7));
    s.engaged = random.below(2) == 0;
    s.sample_tick = tick;
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    ToolRecord& t = r.tools[j];
    fill(t.q);
    for (auto* v : {&t.x, &t.x_tool, &t.f_cmd, &t.f_env, &t.e_p_axis_j}) fill(*v);
    for (double* value : {&t.penetration, &t.mfs_j, &t.e_p_j}) *value = any();
    for (std::size_t i = 0; i < scene.masters(); ++i) t.alpha[i] = any();
    t.held = random.below(2) == 0;
    t.sample_tick = tick;
  }
  return r;
}

/// A record with moving hands.
inline TickRecord smooth_record(const SceneSpec& scene, std::uint32_t tick) {
  TickRecord r;
  r.tick = tick;
  r.time_ns = std::int64_t{tick} * 1'000'000;
  r.running = true;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    r.seats[i].x = {0.001 * tick, 0, 0.1 * static_cast<double>(i)};
    r.seats[i].sample_tick = tick;
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) r.tools[j].sample_tick = tick;
  return r;
}

/// All bits are equal, also of NaN. Padding is not compared, because both are made by the same fields.
inline bool same_bits(const TickRecord& a, const TickRecord& b) {
  const auto bits = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  bool same = a.tick == b.tick && a.time_ns == b.time_ns && a.running == b.running &&
              a.stopped_ticks == b.stopped_ticks && a.dropped_ticks == b.dropped_ticks;
  for (std::size_t i = 0; i < a.seats.size(); ++i) {
    const SeatRecord &s = a.seats[i], &t = b.seats[i];
    same = same && bits(s.alpha, t.alpha) && bits(s.q, t.q) && bits(s.x, t.x) && bits(s.v, t.v) &&
           bits(s.f_cmd, t.f_cmd) && bits(s.f_out, t.f_out) && s.e_in == t.e_in && s.e_out == t.e_out &&
           bits(s.dissipated_j, t.dissipated_j) && bits(s.refused_j, t.refused_j) &&
           bits(s.margin_min_j, t.margin_min_j) && bits(s.delivered_j, t.delivered_j) && s.leader == t.leader &&
           bits(s.ghost, t.ghost) && s.gate == t.gate && s.engaged == t.engaged && s.sample_tick == t.sample_tick;
  }
  for (std::size_t j = 0; j < a.tools.size(); ++j) {
    const ToolRecord &s = a.tools[j], &t = b.tools[j];
    same = same && bits(s.q, t.q) && bits(s.x, t.x) && bits(s.x_tool, t.x_tool) && bits(s.f_cmd, t.f_cmd) &&
           bits(s.f_env, t.f_env) && bits(s.penetration, t.penetration) && s.held == t.held && bits(s.mfs_j, t.mfs_j) &&
           bits(s.e_p_j, t.e_p_j) && bits(s.e_p_axis_j, t.e_p_axis_j) && s.sample_tick == t.sample_tick &&
           bits(s.alpha, t.alpha);
  }
  return same;
}

inline std::string recording_of(const SceneSpec& scene, const std::vector<TickRecord>& records) {
  RecordingWriter writer{scene, sample_info(scene)};
  for (const TickRecord& record : records) writer.add(record);
  writer.finish();
  return writer.take();
}

}  // namespace tandem::server::test
