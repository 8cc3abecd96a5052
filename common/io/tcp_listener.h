#pragma once

#include <expected>
#include <string>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::io {

/// A listening TCP socket, non-blocking, closed on exec.
struct TcpListener {
  Fd fd;
  SocketAddress local;  ///< with the port in force
};

/// Listens for connections; the address can be reused at once after a restart.
/// @return the socket, or the error with its remedy
[[nodiscard]] std::expected<TcpListener, std::string> listen_tcp(const SocketAddress& at);

}  // namespace tandem::io
