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

/// Listens for connections; the address may be used again at once after a restart.
/// @return the socket, or what went wrong and what to do about it
[[nodiscard]] std::expected<TcpListener, std::string> listen_tcp(const SocketAddress& at);

}  // namespace tandem::io
