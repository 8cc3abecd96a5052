#pragma once

#include <optional>
#include <string>

#include "proto/rpc/rpc_messages.h"
#include "server/app/control/join_handler.h"
#include "server/app/control/session_entry.h"

namespace tandem::server {

/// Command with which an operator makes a ticket. @param what  the seat or role, as options
[[nodiscard]] inline std::string ticket_command(const SessionEntry& entry, const std::string& what,
                                                const std::string& workstation) {
  return "`tandem-server ticket --session " + entry.registration.name + " " + what + " --workstation " + workstation +
         "`";
}

[[nodiscard]] inline rpc::ErrorReply seat_taken(const std::string& seat) {
  return {rpc::ErrorCode::kSeatTaken, "seat " + seat + " is taken already", 2};
}

/// Reply to a question that the shard has no place for now.
[[nodiscard]] inline rpc::ErrorReply shard_busy() {
  return {rpc::ErrorCode::kFull, "the server has too many requests to answer now; try again in 1 s", 1};
}

[[nodiscard]] inline rpc::ErrorReply nothing_to_resume() {
  return {
      rpc::ErrorCode::kResume,
      "nothing to resume: the seat was given to another client, the resume secret has expired, or the former server "
      "failed before it had stored this seat",
      0};
}

/// Error reply if the session's code does not admit to a seat of this role; nullopt if it does.
[[nodiscard]] inline std::optional<rpc::ErrorReply> code_refusal(const SessionEntry& entry, const JoinRequest& request,
                                                                 const std::string& code, AccessRole role) {
  if (entry.removed.contains(request.workstation.spki))
    return rpc::ErrorReply{rpc::ErrorCode::kNotAllowed,
                           "the participant of this workstation was removed from the session; to join again, ask an "
                           "operator for a ticket",
                           0};
  if (entry.registration.code.empty() || code != entry.registration.code)
    return rpc::ErrorReply{rpc::ErrorCode::kCode, "this is not the session's code", 0};
  if (role == AccessRole::kInstructor)
    return rpc::ErrorReply{rpc::ErrorCode::kNotAllowed,
                           "the instructor's seat needs a ticket: on the server, " +
                               ticket_command(entry, "--seat " + request.hello.seat, request.workstation.name),
                           0};
  return std::nullopt;
}

/// As `nothing_to_resume`, to a console.
[[nodiscard]] inline rpc::ErrorReply console_is_gone() {
  return {rpc::ErrorCode::kResume,
          "this console cannot come back: its connection ended more than 60 s ago, or at another server; ask an "
          "operator for a new ticket",
          0};
}

}  // namespace tandem::server
