#pragma once

#include <expected>
#include <string>

#include "client/app/join_client.h"

namespace tandem::client {

/// Joins a console again after its connection ended, because its service may have moved the session to another server.
/// The former server makes tickets of consoles valid again when it hands a session over. Blocks for at most 15 s, or
/// until a readable `options.signals`.
/// @return the console at the new server; or the reason of the last attempt, empty if a signal ended it
[[nodiscard]] std::expected<Console, std::string> follow_session(const JoinOptions& options);

}  // namespace tandem::client
