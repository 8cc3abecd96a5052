#pragma once

#include <expected>
#include <string>

#include "common/io/fd.h"
#include "common/io/socket_address.h"
#include "common/io/udp_socket.h"

namespace tandem::io {

/// A listening TCP socket, non-blocking, closed on exec.
struct TcpListener {
  Fd fd;
  SocketAddress local;  ///< with the port in force
};

/// Listens for connections; the address may be used again at once after a restart.
/// @return the socket, or what went wrong and what to do about it
[[nodiscard]] std::expected<TcpListener, std::string> listen_tcp(const SocketAddress& at);

/// UDP and TCP on the same port: datagrams, and the control connection of those who join.
struct SocketPair {
  UdpSocket udp;
  TcpListener tcp;
};
/// @param at  port 0: one that is free for both  @param local_wanted  as in bind_udp
[[nodiscard]] std::expected<SocketPair, std::string> bind_pair(const SocketAddress& at, bool local_wanted = false);

}  // namespace tandem::io
