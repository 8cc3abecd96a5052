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

/// Returns the authority of all master seats as text, e.g. `trainer 0.5, trainee 0.5`.
[[nodiscard]] std::string weights_text(const rpc::Status& status, std::span<const double> alpha);
/// True if the session is paused or stopped.
[[nodiscard]] bool is_stopped(const rpc::Status& status) noexcept;
/// Returns the origin and reason of a stop and the ways to end it in one line: `STOPPED by desk (operator): fire drill.
/// It can be ended by: ...`. Texts of other participants are sanitised.
/// @pre is_stopped(status)
[[nodiscard]] std::string stop_text(const rpc::Status& status);
/// Returns the progress of a drain: `DRAINING: 27 s left, 2 sessions, 3 people on their seats`
[[nodiscard]] std::string drain_text(const rpc::StatusDrain& drain);
/// Returns the changes between two statuses as lines: resumes and removals with their origin, a new stop, drain
/// progress. A drain is reported every ten seconds, and in each of its last five seconds. Empty without changes.
[[nodiscard]] std::string status_changes_text(const rpc::Status& before, const rpc::Status& now);
/// Returns the session status as text: one line, then one per seat and per tool.
[[nodiscard]] std::string status_text(const rpc::Status& status);
/// Returns the session status as JSON. `stops` is the number of the newest stop, which a resume names; each restore of
/// the session (a restart of its server, its move or the death of its server in a service) takes a number too:
/// `{"session", "id", "phase", "time_s", "stops", "authority_version", "draining", "shed", "seats": [{"name", "role",
/// "taken", "heard", "person"}], "tools": [{"name", "alpha": {SEAT: WEIGHT}}], "stop": null or
/// {"number", "kind", "seat", "workstation", "role", "why", "ago_s", "ends", "yours", "person"}, "drain": null or
/// {"left_s", "sessions", "people"}, "held": null or why no tool moves, "counts": null (not known) or {"stops",
/// "restarts", "moves"}, which `stops` counts together,
/// "recording": null or as `recording_json`}`
[[nodiscard]] std::string status_json(const rpc::Status& status);

}  // namespace tandem::client
