#pragma once

#include <string>
#include <variant>

#include "proto/rpc/rpc_messages.h"

/// Replies to peers of older releases. A receiver rejects a whole frame with a value that it does not know.
namespace tandem::rpc {

/// Replaces values in a reply that a client of before SessionPhase::kHeld does not know. Such a client shows a session
/// that is held as running, as before; the reason is in Status::held. It gets neither Status::counts nor
/// Status::not_stored. An order that was carried out and is not stored becomes an error: its text says both.
inline void write_for_older_peer(Body& reply) {
  const auto write = [](SessionPhase& phase) {
    if (phase == SessionPhase::kHeld) phase = SessionPhase::kRunning;
  };
  if (auto* const list = std::get_if<SessionList>(&reply)) {
    for (ListedSession& session : list->sessions) write(session.phase);
  } else if (auto* const status = std::get_if<Status>(&reply)) {
    write(status->phase);
    status->counts.reset();
    status->not_stored.clear();
  } else if (auto* const created = std::get_if<SessionCreated>(&reply)) {
    write(created->session.phase);
  } else if (auto* const ok = std::get_if<Ok>(&reply); ok != nullptr && !ok->not_stored.empty()) {
    reply = ErrorReply{ErrorCode::kNotNow, std::string(ok->not_stored), 0};
  }
}

}  // namespace tandem::rpc
