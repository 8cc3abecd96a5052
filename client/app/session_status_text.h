#pragma once

#include <span>
#include <string>

#include "proto/rpc/rpc_messages.h"

/// The status of a session as consoles show it, as text and as JSON.
namespace tandem::client {

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
/// "restarts", "moves"}, which `stops` counts together, "not_stored": null or why the state cannot be stored,
/// "recording": null or as `recording_json`}`
[[nodiscard]] std::string status_json(const rpc::Status& status);

}  // namespace tandem::client
