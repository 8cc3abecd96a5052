#pragma once

#include "proto/rpc/rpc_messages.h"

/// Replies to peers of older releases. A receiver rejects a whole frame with a value that it does not know.
namespace tandem::rpc {

/// Replaces values in a reply that a client of before SessionPhase::kHeld does not know. Such a client shows a session
/// that is held as running, as before; the reason is in Status::held. It gets no Status::counts.
inline void write_for_older_peer(Body& reply) {
  const auto write = [](SessionPhase& phase) {
    if (phase == SessionPhase::kHeld) phase = SessionPhase::kRunning;
  };
  if (auto* const list = std::get_if<SessionList>(&reply)) {
    for (ListedSession& session : list->sessions) write(session.phase);
  } else if (auto* const status = std::get_if<Status>(&reply)) {
    write(status->phase);
    status->counts.reset();
  } else if (auto* const created = std::get_if<SessionCreated>(&reply)) {
    write(created->session.phase);
  }
}

}  // namespace tandem::rpc
