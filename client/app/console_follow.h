#pragma once

#include <expected>
#include <string>

#include "client/app/join_client.h"
#include "client/app/telemetry_feed.h"

namespace tandem::client {

/// Joins a console again after its connection ended, because its service may have moved the session to another server,
/// or its server has died. The ticket of a console is valid again there. Blocks for at most 15 s, or until a readable
/// `options.signals`.
/// @return the console at the new server; or the reason of the last attempt, empty if a signal ended it
[[nodiscard]] std::expected<Console, std::string> follow_session(const JoinOptions& options);
/// The same for a console that watches the session. @pre as `TelemetryFeed::open`
[[nodiscard]] std::expected<TelemetryFeed, std::string> follow_watched_session(const JoinOptions& options);

}  // namespace tandem::client
