#pragma once

#include <cstdint>
#include <optional>

#include "common/base/time.h"
#include "server/app/attendance.h"

namespace tandem::server {

/// Why a session ended. kPeopleLeft: of a scene without an end, everybody left as people leave.
enum class End : std::uint8_t { kScene, kSignal, kNobodyCame, kPeersLost, kPeopleLeft };

/// A session that nobody stopped ends because its people are not there: why, and what is told of it.
struct SessionEnding {
  struct When {
    Time now{}, began{};              ///< began: the server
    double wait_s = 0;                ///< for the required seats, since the server began; 0: no limit
    std::optional<Time> back_until{}; ///< people of a restored session may come back so long; nothing: the session is new
  };
  End why = End::kNobodyCame;
  Attendance::Note note;
};

/// Whether the session has to end now; nothing: it goes on.
/// @param news  of the same look at `status`
[[nodiscard]] std::optional<SessionEnding> session_ending(const SessionEnding::When& when, const Attendance::News& news, const SessionStatus& status,
                                                          const SceneSpec& scene);

}  // namespace tandem::server
