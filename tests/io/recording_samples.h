#pragma once

#include <cmath>
#include <cstdint>
#include <expected>
#include <span>
#include <string>

#include "proto/recording/lesson_reader.h"
#include "proto/text/scene_bytes.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/recording/recording_info.h"
#include "server/report/tick_record.h"

namespace tandem::server::test {

inline SceneSpec scene_named(const std::string& name) {
  return *parse_scene(find_shipped_scene(name)->text, name + ".textproto");
}

inline RecordingInfo info_of(const SceneSpec& scene) {
  RecordingInfo info;
  info.session = "lab";
  info.scene_text = scene_file_text(scene);
  info.start_unix_ns = 1'700'000'000'000'000'000;
  return info;
}

/// Record of a tick, at 1 kHz, with values that change at every tick, as those of hands do.
inline TickRecord record_at(const SceneSpec& scene, std::uint32_t tick) {
  TickRecord record;
  record.tick = tick;
  record.time_ns = std::int64_t{1'000'000} * tick;
  record.running = true;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    SeatRecord& seat = record.seats[i];
    const double phase = 1e-3 * tick * (1 + 0.1 * static_cast<double>(i));
    seat.alpha = 1.0 / static_cast<double>(scene.seats.size());
    seat.x = {0.05 * std::sin(phase), 0.03 * std::cos(1.7 * phase), 1e-9 * tick};
    seat.v = {0.05 * std::cos(phase), -0.05 * std::sin(1.7 * phase), 1e-6};
    seat.q = {seat.x[0], seat.x[1], seat.x[2]};
    seat.f_cmd = seat.f_out = {2 * std::sin(3 * phase), std::cos(phase), 0.1 * std::sin(11 * phase)};
    seat.e_in[0] = tick * 10U;
    seat.e_out[0] = tick * 9U;
    seat.dissipated_j = 1e-6 * tick;
    seat.engaged = true;
    seat.gate = wire::GateState::kActive;
    seat.sample_tick = tick;
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    ToolRecord& tool = record.tools[j];
    tool.x = tool.x_tool = record.seats[0].x;
    tool.f_env = record.seats[0].f_out;
    tool.held = false;
    tool.sample_tick = tick;
    tool.alpha[0] = 1;
  }
  return record;
}

/// Recorded + dropped + never received = ticks in every channel, and rows are what the file says.
/// @return the error
inline std::string account_problem(const Lesson& lesson) {
  if (lesson.rows() == 0) return lesson.counts.empty() ? "" : "counts without rows";
  const std::uint64_t ticks = lesson.tick.back() - lesson.tick.front() + 1;
  for (const auto& [topic, count] : lesson.counts) {
    const std::uint64_t sum = count.recorded + count.dropped + count.never_received;
    // Ticks that were lost behind the last row count, too.
    if (sum < ticks)
      return topic + ": " + std::to_string(sum) + " of " + std::to_string(ticks) + " ticks are accounted";
    if (topic == "/" + lesson.scene.tools[0].name && count.recorded != lesson.rows())
      return topic + ": " + std::to_string(count.recorded) + " recorded, " + std::to_string(lesson.rows()) + " rows";
  }
  return lesson.counts.empty() ? "no counts" : "";
}

inline std::expected<Lesson, std::string> lesson_of(const std::string& bytes) {
  return read_lesson(std::as_bytes(std::span(bytes)));
}

}  // namespace tandem::server::test
