#include <utility>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "server/app/control/session_registry.h"

/// Notices of resumes and removals for all participants of a session (rpc::StatusEvent).
namespace tandem::server {

void SessionRegistry::add_notice(SessionEntry& room, const std::string& text) {
  if (room.notices.list.size() == rpc::kStatusEventsMax) room.notices.list.erase(room.notices.list.begin());
  room.notices.list.push_back({++room.notices.count, truncate_utf8(text, rpc::kTextMax)});
}

/// Adds a notice for a stop that ended. A key at a seat may have ended it, which only the session's stop latch
/// records.
void SessionRegistry::report_resume(SessionEntry& room, const CommandOutcome& outcome) {
  const StopLatch::Ended& ended = outcome.stop_latch.ended();
  if (ended.number == 0 || ended.number == std::exchange(room.notices.resume_reported, ended.number)) return;
  const SceneSpec& scene = room.registration.session->scene();
  std::string who = ended.by < scene.seats.size()
                        ? scene.seats[ended.by].name + " (" + std::string(to_text(ended.role)) + ")"
                        : "a console";
  if (room.notices.resumed == ended.number) who = room.notices.resumer;
  add_notice(room, format("stop %u is over: RESUMED by ", ended.number) + who +
                       format("; force returns over %.1f s", scene.gate.ramp_in));
}

}  // namespace tandem::server
