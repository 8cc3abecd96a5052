#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "server/app/monitor/session_status.h"

namespace tandem::server {

/// Detects joins, leaves and absences of participants from a session's status.
class PresenceTracker {
 public:
  static constexpr Duration kLost = std::chrono::seconds(10);  ///< absence after which a warning names the seat

  struct Event {
    const char* event;     ///< joined, left, back, gone, everybody_left, running, paused, stopped, overloaded or braked
    std::string seat;      ///< empty: the whole session
    std::string text;      ///< message for users
    bool warning = false;  ///< a participant is absent, or the session is overloaded
  };
  struct Events {
    std::vector<Event> events;
    bool all_lost = false;  ///< all participants that ever joined have been away for kSessionTimeout
    bool all_left = false;  ///< all of them left in an orderly way, at least `kLost` ago
  };
  [[nodiscard]] Events update(Time now, const SessionStatus& status, const SceneSpec& scene);

 private:
  struct Seat {
    bool taken = false, warned = false;
    std::optional<Time> away_since;
  };
  std::array<Seat, kSeatsMax> seats_{};
  std::optional<wire::SessionState> state_;
  bool all_left_before_ = false;  ///< all had left at the last update
};

}  // namespace tandem::server
