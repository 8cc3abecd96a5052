#pragma once

#include <string>

#include "proto/rpc/rpc_messages.h"
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

[[nodiscard]] inline rpc::ErrorReply nothing_to_resume() {
  return {
      rpc::ErrorCode::kResume,
      "nothing to resume: the seat was given to another client, the resume secret has expired, or the former server "
      "failed before it had stored this seat",
      0};
}

/// As `nothing_to_resume`, to a console.
[[nodiscard]] inline rpc::ErrorReply console_is_gone() {
  return {rpc::ErrorCode::kResume,
          "this console cannot come back: its connection ended more than 60 s ago, or at another server; ask an "
          "operator for a new ticket",
          0};
}

}  // namespace tandem::server
