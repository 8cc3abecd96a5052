#pragma once

#include <optional>
#include <string>

#include "common/base/time.h"

namespace tandem::server {

/// Load of a session of this server.
struct SessionLoad {
  std::string session;
  double cost = 0;       ///< measured processor time [cores]
  double expected = 0;   ///< when all its seats are taken [cores]
  bool waiting = false;  ///< no seat is taken, and no console is joined
};

/// Notes of SessionMoves on a session of this server. They end with the session.
struct MoveNotes {
  std::optional<SessionLoad> load{};
  std::string target{};               ///< of the newest move
  int steps_until_move = -1;          ///< after the hand-over; -1: not handed over, or the ownership is moving
  std::optional<Time> handed_over{};  ///< of the newest move; nullopt: the session still runs here
  Time next_standby{};                ///< then a standby is chosen
};

}  // namespace tandem::server
