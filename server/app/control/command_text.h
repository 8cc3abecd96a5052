#pragma once

#include <string>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"
#include "server/session/seat_catalogue.h"
#include "server/session/session_command.h"

/// Texts about commands: replies to clients, lines of the audit log and messages. Pure.
namespace tandem::server {

/// Reason that the client gave with the command; empty: none.
[[nodiscard]] std::string why_in(const rpc::Body& command);
/// Word of the audit log for a command, such as `stop`.
[[nodiscard]] const char* audit_word(const rpc::Body& command) noexcept;
/// Details for the audit log: client, object and numbers of the command.
/// @param who  workstation, role and seat of the client
[[nodiscard]] std::string audit_detail(const std::string& who, const SessionCommand& command,
                                       const CommandOutcome& outcome, const SceneSpec& scene);
/// Message for the operator of the server about an executed command; empty: no message.
[[nodiscard]] std::string operator_message(const std::string& who, const rpc::Body& command);
/// Text for the sender of an order that was carried out and is not stored. @param why  cause and remedy
[[nodiscard]] std::string not_stored_text(const rpc::Body& command, const std::string& why);
/// Whether the sender may not give this command: its role lacks the right, or the client lost its seat.
[[nodiscard]] bool is_forbidden(const CommandOutcome& outcome) noexcept;
/// Reply to the client of any command except a status request: Ok, AuthorityReply or ErrorReply.
[[nodiscard]] rpc::Body command_reply(const rpc::Body& command, AccessRole role, const CommandOutcome& outcome,
                                      const SeatCatalogue& seats);

}  // namespace tandem::server
