#pragma once

#include <expected>

#include "client/app/join_client.h"
#include "client/app/server_connection.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Returns a Hello with what the options alone determine: seat, device, ciphers, and a random connection id. It names
/// no session and has no credential.
[[nodiscard]] rpc::Hello base_hello(const JoinOptions& options);

/// Returns the Hello of a join: the session and the credential. The credential is the secret, ticket or code of the
/// options, or on the server's own computer a ticket signed here. Asks the server for its sessions where a name must be
/// found.
/// @pre `server` is connected
[[nodiscard]] std::expected<rpc::Hello, JoinError> make_hello(ServerConnection& server);

}  // namespace tandem::client
