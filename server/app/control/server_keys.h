#pragma once

#include <expected>
#include <string>
#include <vector>

#include "common/auth/io/server_keystore.h"
#include "common/io/socket_address.h"

/// Keys and address of a server, before anything starts.
namespace tandem::server {

/// Opens the keys of a directory made by `init`, or creates ephemeral keys: for loopback without a state directory.
/// Beyond loopback at least one workstation must be able to join.
/// @param state  directory as given; empty: the default directory, or ephemeral keys
[[nodiscard]] std::expected<auth::ServerKeystore, std::string> open_server_keys(const io::SocketAddress& listen,
                                                                                const std::string& state);
/// All errors in the keys and the registry, for `--check`. Opens and changes nothing.
[[nodiscard]] std::vector<std::string> problems_with_keys(const io::SocketAddress& listen, const std::string& state);
/// Why this computer cannot listen at the address; empty if it can.
[[nodiscard]] std::string problem_with_address(const io::SocketAddress& listen);

}  // namespace tandem::server
