#pragma once

#include <string>

#include "common/io/socket_address.h"
#include "server/app/session_run.h"

namespace tandem::server {

/// What is said of a session that opens: its scene, and for each seat the command that a person types to sit there.
/// @param at          where clients dial  @param throw_away  keys made on the spot: no tickets  @param several  sessions are served
/// @param folder      the server's state folder, for the commands about tickets
/// @param read_code   how an operator reads the session's code, where this text may be kept or read by others; empty: the code is shown
[[nodiscard]] std::string announcement(const SessionRun& run, const io::SocketAddress& at, bool throw_away, bool several, const std::string& folder,
                                       const std::string& read_code);

}  // namespace tandem::server
