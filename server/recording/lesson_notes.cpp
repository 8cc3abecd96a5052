#include "server/recording/lesson_notes.h"

#include "server/report/audit_text.h"

namespace tandem::server {

LessonEvent lesson_event(const AuditEvent& event, const SceneSpec& scene, Duration elapsed) {
  LessonEvent out;
  out.tick = event.tick;
  out.time_ns = elapsed.count();
  out.what = to_text(event.what);
  if (event.seat < scene.seats.size()) out.seat = scene.seats[event.seat].name;
  out.text = audit_text(event, scene);
  return out;
}

LessonLink lesson_link(const wire::WatchedLink& link, std::uint32_t tick) noexcept {
  return {.tick = tick,
          .seat = link.seat,
          .rtt_p50_ms = link.rtt_p50_ms,
          .loss_up_percent = link.loss_up_percent,
          .loss_down_percent = link.loss_down_percent,
          .gap_up_ms = link.gap_up_ms,
          .gap_down_ms = link.gap_down_ms,
          .age_p99_ms = link.age_p99_ms,
          .gate_trips = link.gate_trips,
          .late_ticks = link.late_ticks};
}

}  // namespace tandem::server
