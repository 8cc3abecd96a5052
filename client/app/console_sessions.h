#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "client/app/join_client.h"
#include "proto/rpc/rpc_messages.h"

/// Commands of the operator console about the server's sessions: their parsing, requests and texts.
namespace tandem::client {

/// Command `create`. `creation_order` reads the scene, if it is a file.
struct CreateCommand {
  std::string name, scene;  ///< scene: a file if it has a slash or a dot, else the name of a scene of the server
  bool tickets_only = false;
  std::uint32_t life_s = 0;  ///< [s]; 0: no limit
  std::vector<rpc::SeatHolder> holders;
};
/// Command `end`.
struct EndCommand {
  std::string session;  ///< name or id
  std::string why;
};
/// Command `sessions`.
struct SessionsCommand {};

/// Parses the words after `create`. @return the command, or the error with the expected form
[[nodiscard]] std::expected<CreateCommand, std::string> parse_creation(const std::vector<std::string>& words);
/// Parses the words after `note`.
[[nodiscard]] std::expected<rpc::Note, std::string> parse_note(const std::vector<std::string>& words);

/// Returns the request of a command, with the text of a scene file, or all mistakes of that file.
[[nodiscard]] std::expected<rpc::CreateSession, std::string> creation_order(const CreateCommand& command);
/// Returns the id of the session that a user names by name or id, or the error with the known names.
[[nodiscard]] std::expected<rpc::Id, std::string> listed_session(const rpc::SessionList& list,
                                                                 const std::string& typed);

/// Returns a created session as text: name, code, id, one line per seat, then one per ticket.
/// @param server  address as HOST:PORT, for the commands that participants type
[[nodiscard]] std::string created_text(const rpc::SessionCreated& created, const JoinOptions& asked);
/// Returns a created session as JSON: `{"session", "id", "code": null or CODE, "seats": [{"name", "role"}], "tickets":
/// [{"seat", "workstation", "ticket"}]}`
[[nodiscard]] std::string created_json(const rpc::SessionCreated& created);

}  // namespace tandem::client
