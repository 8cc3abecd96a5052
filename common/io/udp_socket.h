#pragma once

#include <expected>
#include <string>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::io {

/// A UDP socket, non-blocking, closed on exec.
struct UdpSocket {
  Fd fd;
  SocketAddress local;  ///< with the port in force
};

/// Binds a socket that many peers may send to.
/// @param local_wanted  datagrams shall tell which local address they were sent to (sockets bound to "any")
/// @return the socket, or what went wrong and what to do about it
[[nodiscard]] std::expected<UdpSocket, std::string> bind_udp(const SocketAddress& at, bool local_wanted = false);

/// A socket for one peer only: others' datagrams never reach it, and "nobody listens there" is told by the system.
[[nodiscard]] std::expected<UdpSocket, std::string> connect_udp(const SocketAddress& to);

}  // namespace tandem::io
