#include <utility>

#include "common/base/format.h"
#include "common/base/printable.h"
#include "server/app/house.h"

/// What everybody in a session reads of resumes and removals (control::StatusNews).
namespace tandem::server {

void House::add_news(Room& room, const std::string& text) {
  if (room.news.list.size() == control::kStatusNewsMax) room.news.list.erase(room.news.list.begin());
  room.news.list.push_back({++room.news.count, cut_to(text, control::kTextMax)});
}

/// A stop may be ended by a key at a seat: only the session's lane knows of that.
void House::look_for_resume(Room& room, const Outcome& outcome) {
  const StopLane::Ended& ended = outcome.lane.ended();
  if (ended.number == 0 || ended.number == std::exchange(room.news.resume_told, ended.number)) return;
  const SceneSpec& scene = room.opening.session->scene();
  std::string who = ended.by < scene.seats.size() ? scene.seats[ended.by].name + " (" + std::string(to_text(ended.role)) + ")" : "a console";
  if (room.news.resumed == ended.number) who = room.news.resumer;
  add_news(room, format("stop %u is over: RESUMED by ", ended.number) + who + format("; force returns over %.1f s", scene.gate.ramp_in));
}

}  // namespace tandem::server
