#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "server/recording/recording_writer.h"
#include "tests/io/recording_samples.h"

namespace tandem::test {

/// Bytes of a recording of a shipped scene with hands that move on known curves, for tests of its readers.
/// @param missing  whether a tick gets no row; empty: none
/// @param change   changes the record of a tick before it is written; empty: no change
[[nodiscard]] inline std::vector<std::byte> recorded_bytes(
    const std::string& scene_name, double seconds, const std::function<bool(std::uint32_t)>& missing = {},
    const std::function<void(server::TickRecord&)>& change = {}) {
  const SceneSpec scene = server::test::scene_named(scene_name);
  server::RecordingWriter writer(scene, server::test::info_of(scene));
  writer.set_persons({"Ada", "Bo"});
  writer.add_event({.tick = 0, .time_ns = 0, .what = "join", .seat = scene.seats[0].name, .text = "begins"});
  const auto ticks = static_cast<std::uint32_t>(seconds * scene.tick_hz);
  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
    if (missing && missing(tick)) continue;
    server::TickRecord record = server::test::record_at(scene, tick);
    if (change) change(record);
    writer.add(record);
  }
  writer.add_mark({.t_s = seconds / 2, .by = "eva", .text = "half"});
  writer.finish();
  const std::string text = writer.take();
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace tandem::test
