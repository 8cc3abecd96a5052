#pragma once

#include <string>

#include "common/io/socket_address.h"
#include "server/app/process/session_instance.h"

namespace tandem::server {

/// Text that describes a new session: its scene, the seats that recorded hands play, and the command to join each
/// other seat.
/// @param at           address for clients
/// @param ephemeral_keys  the keys are ephemeral: no tickets
/// @param several      several sessions are served
/// @param folder       the server's state directory, for the commands about tickets
/// @param read_code    command with which an operator reads the session's code, if the text may be stored or read by
/// others; empty: the text contains the code
[[nodiscard]] std::string startup_banner(const SessionInstance& run, const io::SocketAddress& at, bool ephemeral_keys,
                                         bool several, const std::string& folder, const std::string& read_code);

}  // namespace tandem::server
