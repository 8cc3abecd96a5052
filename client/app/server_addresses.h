#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/app/join_client.h"
#include "common/io/socket_address.h"
#include "proto/spec/registry_spec.h"

namespace tandem::client {

/// Addresses at which a client tries to connect, at most.
inline constexpr std::size_t kAddressesTried = 32;

/// Sets the server and the alternatives of the options. A name may have several addresses.
/// @param text  HOST:PORT, or several separated by commas: servers of one service
/// @return the error; empty if at least one address was found
[[nodiscard]] std::string set_server_addresses(std::string_view text, JoinOptions& options);

/// Returns the addresses to try, in that order and each once: those of the options, then those of the servers that the
/// workstation has learnt from any of them.
/// @param known  servers at which the workstation is enrolled
[[nodiscard]] std::vector<io::SocketAddress> addresses_to_try(const JoinOptions& options,
                                                              const std::vector<ServerRow>& known);

/// Adds the addresses of `HOST:PORT` that are not in the list yet; none if the name cannot be resolved.
void add_addresses(std::string_view text, std::vector<io::SocketAddress>& list);

}  // namespace tandem::client
