#pragma once

#include <expected>
#include <string>
#include <vector>

#include "common/io/datagram_steering.h"
#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::io {

/// A UDP socket, non-blocking, closed on exec.
struct UdpSocket {
  Fd fd;
  SocketAddress local;  ///< with the port in force
};

/// Binds a socket to which many peers may send.
/// @param local_wanted  datagrams report the local address they were sent to (sockets bound to "any")
/// @return the socket, or the error with its remedy
[[nodiscard]] std::expected<UdpSocket, std::string> bind_udp(const SocketAddress& at, bool local_wanted = false);

/// Binds several sockets to one address and port, so that each thread has its own while firewalls and proxies see one
/// port. The kernel distributes datagrams (SO_ATTACH_REUSEPORT_CBPF) without copying. A single socket is bound as by
/// `bind_udp`, unless others may follow.
/// @param at  port 0: a free one, the same for all  @return the sockets in order, or the error
[[nodiscard]] std::expected<std::vector<UdpSocket>, std::string> bind_udp_steered(const SocketAddress& at,
                                                                                  const Steering& steering);

/// Binds one more socket to the address and port of steered ones, after them in their order. It gets no datagram until
/// the kernel's program names it.
/// @param socket  one of the sockets that a Steering with `grows` or several sockets made
[[nodiscard]] std::expected<UdpSocket, std::string> bind_udp_beside(const UdpSocket& socket);

/// Opens a socket for one peer only: it never receives datagrams of others, and the system reports if no process
/// listens at the peer.
[[nodiscard]] std::expected<UdpSocket, std::string> connect_udp(const SocketAddress& to);

/// Returns the same socket under another descriptor; its `fd` is closed if the system gave none.
[[nodiscard]] UdpSocket duplicate(const UdpSocket& socket) noexcept;

}  // namespace tandem::io
