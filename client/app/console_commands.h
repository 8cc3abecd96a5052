#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/app/console_sessions.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Command `authority`. It names seats and tools, which `authority_frame` translates to the numbers of a SetAuthority.
struct AuthorityCommand {
  std::vector<std::pair<std::string, double>> weights;  ///< authority by seat; seats not named get 0
  std::string tool = {};                                ///< name of the tool; empty: the only one
  std::optional<std::uint32_t> version = {};            ///< version it replaces; empty: the present one
};
/// Commands that only the console executes.
struct HelpCommand {};
struct QuitCommand {};

/// A command of the operator console, given after `control` or on a line of standard input: the request that the server
/// receives. The sender adds the id of the session, and the number of the present stop to a ResumeSession of stop 0.
using ConsoleCommand = std::variant<rpc::StatusRequest, rpc::StopSession, rpc::PauseSession, rpc::ResumeSession,
                                    AuthorityCommand, rpc::RemoveParticipant, rpc::Drain, CreateCommand, EndCommand,
                                    SessionsCommand, rpc::Note, rpc::RecordSession, HelpCommand, QuitCommand>;

/// Words of a line, separated by white space.
[[nodiscard]] std::vector<std::string> words_of(const std::string& line);

/// Parses a console command. @return the command, or the error with the expected form
[[nodiscard]] std::expected<ConsoleCommand, std::string> parse_command(std::span<const std::string> words);
/// Returns all commands with their arguments, one per line.
[[nodiscard]] const char* console_commands_help() noexcept;
/// Returns the lowest role that may execute the command. On the server's own computer, the client requests this role.
[[nodiscard]] AccessRole role_for(const ConsoleCommand& command) noexcept;

/// Returns the SetAuthority message for an `authority` command, based on the present status. Error: an unknown seat or
/// tool, or authority whose sum is not 1.
[[nodiscard]] std::expected<rpc::SetAuthority, std::string> authority_frame(const AuthorityCommand& wish,
                                                                            const rpc::Status& status);

/// Returns the next step for the user after the server refused `command`; empty: none is known.
/// @param own  role of the console
[[nodiscard]] std::string refusal_hint(const rpc::Body& command, AccessRole own);

}  // namespace tandem::client
