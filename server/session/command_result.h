#pragma once

#include <cstdint>

namespace tandem::server {

/// Answer of a session to a request, by datagram or by control connection.
enum class CommandResult : std::uint8_t {
  kDone,          ///< executed, or scheduled
  kForbidden,     ///< the role may not do this, or not to these seats
  kSeatLost,      ///< the client does not own the seat any more
  kOutdated,      ///< the number or version is not the newest, or nothing is stopped
  kHeldByOthers,  ///< resume: the client's own pause is withdrawn, other seats' pauses are on
  kNothingToDo,   ///< nothing to resume, or no client to remove
  kNoSuchSeat,    ///< removal: the scene has no seat of this name
  kInvalid,       ///< no such tool, wrong number of masters, or not normalisable
  kStaleLink,     ///< a party to the change has a stale link
};

}  // namespace tandem::server
