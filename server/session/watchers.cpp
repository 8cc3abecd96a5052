#include "server/session/watchers.h"

#include <algorithm>
#include <cmath>

namespace tandem::server {

namespace {
constexpr double kSlowestHz = 2;                              // so that a watcher sees that the server is overloaded
constexpr std::uint32_t kRecorderStretch = 10, kStretch = 4;  // of the intervals, at the first shed level

std::uint32_t ticks_of(const SceneSpec& scene, double hz) {
  return std::max(1U, static_cast<std::uint32_t>(std::ceil(scene.tick_hz / hz)));
}
}  // namespace

wire::TelemetryLayout telemetry_layout(const SceneSpec& scene) noexcept {
  return {scene.seats.size(), scene.masters(), scene.tools.size()};
}

Watchers::Watchers(const SceneSpec& scene, const CloseOut& session_end)
    : slots_(kMax, from_seconds(1.0 / scene.tick_hz), session_end),
      codec_(telemetry_layout(scene)),
      usual_(ticks_of(scene, wire::kTelemetryHz)),
      slowest_(ticks_of(scene, kSlowestHz)) {}

std::uint32_t Watchers::interval_shedding(bool recorder, ShedLevel level) const noexcept {
  if (level == ShedLevel::kTelemetry) return recorder ? kRecorderStretch : kStretch * usual_;
  return slowest_;
}

}  // namespace tandem::server
