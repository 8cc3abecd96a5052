#include "server/session/stop_text.h"

#include <algorithm>

namespace tandem::server {

std::string may_end_text(const StopLatch& latch, const SceneSpec& scene, std::uint32_t there) {
  if (!latch.latched()) return {};
  const std::string operators = "an operator (`tandem-client control resume`)";
  if (!latch.pause_ends_by_its_makers())
    return latch.has_instructor() ? "an instructor (key r) or " + operators : operators;
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    if ((latch.holders(there) >> i & 1U) == 0) continue;
    names += (names.empty() ? "" : " and ") + scene.seats[i].name;
    ++count;
  }
  if (count == 0)
    return std::string("any seat that may pause (key r)") +
           (latch.holders(~0U) != 0 ? ", as the seat that paused has left," : "") + " or " + operators;
  return names + (count == 1 ? " (key r), which paused, or " : " (key r each), which paused, or ") + operators;
}

std::optional<tandem::rpc::StatusStop> latest_stop(const StopLatch& latch, const SceneSpec& scene, double ago_s,
                                                   std::uint32_t there) {
  const StopLatch::Latest& newest = latch.latest();
  const bool known = newest.level != StopLatch::Level::kNone;
  if (latch.stops() == 0 || (!known && !latch.latched())) return std::nullopt;
  tandem::rpc::StatusStop stop;
  stop.number = latch.stops();
  stop.kind = (known ? newest.level : latch.level()) == StopLatch::Level::kPaused ? tandem::rpc::StopKind::kPause
                                                                                  : tandem::rpc::StopKind::kStop;
  const StopLatch::Words& words = newest.words;
  stop.person = words.person.view();
  stop.why = words.why.view();
  if (newest.by < scene.seats.size()) {
    stop.seat = scene.seats[newest.by].name;
  } else {
    stop.workstation = words.workstation.view();
  }
  if (known && newest.by == StopLatch::kNoSeat) stop.kind = tandem::rpc::StopKind::kFault;
  if (!known) stop.why = "it is older than this run of the session, and its author was not stored";
  stop.role = newest.role;
  stop.ago_s = std::max(0.0, ago_s);
  stop.ends = may_end_text(latch, scene, there);
  return stop;
}

}  // namespace tandem::server
