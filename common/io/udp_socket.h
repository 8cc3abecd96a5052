#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <vector>

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

/// Which of several sockets gets a datagram: what stands at its byte `byte` decides.
struct Steering {
  std::size_t byte = 0;
  std::size_t sockets = 1;                    ///< 1 ... 64
  std::array<std::uint8_t, 256> socket_of{};  ///< below `sockets`; datagrams that are too short go to socket 0
};
/// Several sockets on one address and port, so that threads do not share one while firewalls and proxies see one port. The kernel steers
/// (SO_ATTACH_REUSEPORT_CBPF); nothing is copied or forwarded. A single socket is bound as `bind_udp` does.
/// @param at  port 0: one that is free, the same for all  @return the sockets in order, or what went wrong
[[nodiscard]] std::expected<std::vector<UdpSocket>, std::string> bind_udp_steered(const SocketAddress& at, const Steering& steering);

/// A socket for one peer only: others' datagrams never reach it, and "nobody listens there" is told by the system.
[[nodiscard]] std::expected<UdpSocket, std::string> connect_udp(const SocketAddress& to);

/// The same socket under another descriptor; its `fd` is closed if the system gave none.
[[nodiscard]] UdpSocket duplicate(const UdpSocket& socket) noexcept;

}  // namespace tandem::io
