#pragma once

#include <string>

#include "common/io/socket_address.h"

namespace tandem::io {

/// Returns the `HOST:PORT` under which clients reach a listener at `at`. For a wildcard address (0.0.0.0, [::]) it is
/// the address by which this machine reaches other networks, else any externally reachable address of it, else
/// loopback. A machine with several networks has further addresses.
[[nodiscard]] std::string reachable_address(const SocketAddress& at);
/// The same for an address as text; text that is no address stays as it is.
[[nodiscard]] std::string reachable_address(const std::string& at);

/// Returns a note for users if commands with `reachable` work on this machine only, although the listener at `at`
/// accepts clients of other machines: it had no network. Else an empty text.
[[nodiscard]] std::string only_here_note(const SocketAddress& at, const std::string& reachable);

}  // namespace tandem::io
