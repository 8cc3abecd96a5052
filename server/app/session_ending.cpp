#include "server/app/session_ending.h"

#include <algorithm>
#include <span>

#include "common/base/format.h"
#include "common/base/silence.h"

namespace tandem::server {
namespace {

/// A session that waits for nobody in particular runs, or is stopped, though nobody came since the restart.
bool nobody_came_back(const SessionStatus& status, const SceneSpec& scene) {
  const std::span seats(status.seats.begin(), scene.seats.size());
  const bool waits = status.waits || status.state == wire::SessionState::kWaiting;
  return std::ranges::none_of(seats, waits ? &SeatStatus::taken : &SeatStatus::ever_taken);
}

}  // namespace

std::optional<SessionEnding> session_ending(const SessionEnding::When& when, const Attendance::News& news, const SessionStatus& status, const SceneSpec& scene) {
  if (news.all_left && scene.endless()) return SessionEnding{End::kPeopleLeft, {"people_left", "", "everybody left 10 s ago; the session ends"}};
  if (news.all_lost)
    return SessionEnding{End::kPeersLost, {"peers_lost", "", format("peers lost: nobody was heard for %.0f s; the session ends", seconds(kSessionSilence)), true}};
  if (when.wait_s > 0 && status.state == wire::SessionState::kWaiting && seconds(when.now - when.began) > when.wait_s)
    return SessionEnding{End::kNobodyCame,
                         {"nobody_came", "", "nobody came for " + waiting_for(status, scene) + format(" within %g s (--wait); the session ends", when.wait_s), true}};
  if (when.back_until && when.now > *when.back_until && nobody_came_back(status, scene))
    return SessionEnding{End::kNobodyCame, {"nobody_came_back", "", "nobody came back within 10 min after the server had ended; the session is over", true}};
  return std::nullopt;
}

}  // namespace tandem::server
