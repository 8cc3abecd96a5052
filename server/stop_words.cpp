#include "server/stop_words.h"

#include <algorithm>

namespace tandem::server {

std::string who_ends(const StopLane& lane, const SceneSpec& scene, std::uint32_t there) {
  if (!lane.on()) return {};
  const std::string operators = "an operator (`tandem-client control resume`)";
  if (!lane.own()) return lane.led() ? "an instructor (key r) or " + operators : operators;
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    if ((lane.holders(there) >> i & 1U) == 0) continue;
    names += (names.empty() ? "" : " and ") + scene.seats[i].name;
    ++count;
  }
  if (count == 0) return "anybody at a seat who may pause (key r), as who paused is not there any more, or " + operators;
  return names + (count == 1 ? " (key r), who paused, or " : " (key r each), who paused, or ") + operators;
}

std::optional<tandem::control::StatusStop> newest_stop(const StopLane& lane, const SceneSpec& scene, double ago_s, std::uint32_t there) {
  const StopLane::Newest& newest = lane.newest();
  const bool known = newest.level != StopLane::Level::kNone;
  if (lane.stops() == 0 || (!known && !lane.on())) return std::nullopt;
  tandem::control::StatusStop stop;
  stop.number = lane.stops();
  stop.kind = (known ? newest.level : lane.level()) == StopLane::Level::kPaused ? tandem::control::StopKind::kPause : tandem::control::StopKind::kStop;
  if (newest.by < scene.seats.size()) stop.seat = scene.seats[newest.by].name;
  if (known && newest.by == StopLane::kNobody) stop.kind = tandem::control::StopKind::kFault;
  if (!known) stop.why = "it was on before the server was restarted";
  stop.role = newest.role;
  stop.ago_s = std::max(0.0, ago_s);
  stop.ends = who_ends(lane, scene, there);
  return stop;
}

}  // namespace tandem::server
