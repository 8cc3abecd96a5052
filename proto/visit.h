#pragma once

#include <cstdint>

#include "proto/wire.h"

/// A visit: who joins only to judge his link sits nowhere. He exchanges STATE and FORCE of the
/// scene's sizes at its rate, so that his link is judged by what a seat would send, and touches no session: what his STATE says is
/// not read, and his FORCE tells what came of it. Joining, sealing and closing are those of a seat.
namespace tandem::wire {

/// What came of a visitor's STATEs. With Preamble::echo_counter, the newest that acted, it gives the loss on the way up.
struct VisitReport {
  std::uint32_t acted = 0;  ///< each newer than all before
  std::uint32_t late = 0;   ///< authentic, but older than one that acted: the network changed their order
};

/// FORCE to a visitor: these two stand where a seat finds the session's tick and the version of authority.
[[nodiscard]] inline ForceMessage force_of(const VisitReport& visit) noexcept {
  ForceMessage m;
  m.session_tick = visit.acted;
  m.authority_version = visit.late;
  return m;
}
[[nodiscard]] inline VisitReport visit_of(const ForceMessage& m) noexcept { return {m.session_tick, m.authority_version}; }

}  // namespace tandem::wire
