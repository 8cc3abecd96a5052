#pragma once

#include <cstdint>
#include <optional>

#include "common/base/time.h"
#include "server/app/monitor/presence_tracker.h"

namespace tandem::server {

/// Why a session ended. kAllLeft: in a scene without an end, all participants left in an orderly way. kOperator: by an
/// order. kTimeLimit: the time that was given when it was created is over. kGivenUp: another server may own it.
enum class EndReason : std::uint8_t {
  kScene,
  kSignal,
  kStartTimeout,
  kPeersLost,
  kAllLeft,
  kOperator,
  kTimeLimit,
  kGivenUp
};

/// Decision to end a session because its participants are absent: reason and event.
struct SessionEnding {
  struct Times {
    Time now{}, began{};         ///< began: start of the server
    double start_timeout_s = 0;  ///< [s] for the required seats, since the server began; 0: no limit
    /// Participants of a restored session must have come back until then; nullopt: there were none.
    std::optional<Time> return_until{};
    std::optional<Time> ends_at{};  ///< time limit of a created session; nullopt: none
  };
  EndReason why = EndReason::kStartTimeout;
  PresenceTracker::Event event;
};

/// Returns why the session must end now; nullopt: it continues.
/// @param news  events of the same `status`
[[nodiscard]] std::optional<SessionEnding> session_ending(const SessionEnding::Times& when,
                                                          const PresenceTracker::Events& news,
                                                          const SessionStatus& status, const SceneSpec& scene);

}  // namespace tandem::server
