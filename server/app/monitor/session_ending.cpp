#include "server/app/monitor/session_ending.h"

#include <algorithm>
#include <span>

#include "common/base/format.h"
#include "common/base/session_timeout.h"

namespace tandem::server {
namespace {

/// Whether no participant has returned since the restart. A session without required seats runs, or is stopped, even
/// then.
bool none_returned(const SessionStatus& status, const SceneSpec& scene) {
  const std::span seats(status.seats.begin(), scene.seats.size());
  const bool waits = status.waiting || status.state == wire::SessionState::kWaiting;
  return std::ranges::none_of(seats, waits ? &SeatStatus::taken : &SeatStatus::ever_taken);
}

}  // namespace

std::optional<SessionEnding> session_ending(const SessionEnding::Times& when, const PresenceTracker::Events& news,
                                            const SessionStatus& status, const SceneSpec& scene) {
  if (when.ends_at && when.now >= *when.ends_at)
    return SessionEnding{EndReason::kTimeLimit,
                         {"time_limit", "", "the time given to this session when it was created is over; it ends"}};
  if (news.all_left && scene.endless())
    return SessionEnding{EndReason::kAllLeft, {"people_left", "", "all participants left 10 s ago; the session ends"}};
  if (news.all_lost)
    return SessionEnding{
        EndReason::kPeersLost,
        {"peers_lost", "",
         format("peers lost: no datagram from any client for %.0f s; the session ends", seconds(kSessionTimeout)),
         true}};
  if (when.start_timeout_s > 0 && status.state == wire::SessionState::kWaiting &&
      seconds(when.now - when.began) > when.start_timeout_s)
    return SessionEnding{EndReason::kStartTimeout,
                         {"nobody_came", "",
                          "required seats not ready: " + waiting_for(status, scene) +
                              format(" within %g s (--start-timeout); the session ends", when.start_timeout_s),
                          true}};
  if (when.return_until && when.now > *when.return_until && none_returned(status, scene))
    return SessionEnding{
        EndReason::kStartTimeout,
        {"nobody_came_back", "",
         "no participant came back within 10 min after the server had ended; the session is over", true}};
  return std::nullopt;
}

}  // namespace tandem::server
