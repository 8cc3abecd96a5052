#pragma once

#include "netsim/system/observed_seat.h"

namespace tandem::netsim {

/// Returns whether the state disengages all hands: a stopped or paused session, or an overloaded server.
[[nodiscard]] constexpr bool disengages_all(wire::SessionState state) noexcept {
  return state == wire::SessionState::kStopped || state == wire::SessionState::kPaused ||
         state == wire::SessionState::kOverloaded;
}

/// Checks the rights of a seat's role with a copy of the rules. Observers receive no force. A stopped hand is
/// disengaged. A stopped session engages no seat.
void check_role(const ObservedSeat& seat);

/// Checks that the role of the event's seat permits the event. Only instructors stop a session, resume it and
/// distribute authority; trainees and evaluators may pause it, and trainees may give their own authority to
/// instructors.
/// @param t  session time for violations [s]
void check_role(const server::AuditEvent& event, const SceneSpec& scene, double t, server::Violations& violations);

}  // namespace tandem::netsim
