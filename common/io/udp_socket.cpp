#include "common/io/udp_socket.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

#include "common/io/datagram_batch.h"
#include "common/io/tcp_listener.h"

namespace tandem::io {
namespace {

constexpr int kBacklog = 1024;  // a whole class of clients joins at once

std::string bind_problem(const SocketAddress& address, int error) {
  const std::string where = to_text(address);
  switch (error) {
    case EADDRINUSE:
      return where + " is in use by another program: stop that program, or choose another port (0 takes a free one)";
    case EADDRNOTAVAIL:
      return where + " is not an address of this computer: use one that `ip address` shows, or 127.0.0.1";
    case EACCES:
      return where + " is not allowed: ports below 1024 need root; choose a higher one";
    default:
      return where + ": " + std::strerror(error);
  }
}

SocketAddress local_address(int fd) {
  SocketAddress local;
  local.size = sizeof local.storage;
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&local.storage), &local.size);
  return local;
}

Fd open_udp(int family) { return Fd{::socket(family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)}; }

/// Binds a socket that shares its address and port with others of this process.
std::expected<UdpSocket, std::string> bind_shared(const SocketAddress& at) {
  UdpSocket socket{open_udp(at.family()), {}};
  const int yes = 1;
  if (!socket.fd.open() || ::setsockopt(socket.fd.get(), SOL_SOCKET, SO_REUSEPORT, &yes, sizeof yes) != 0 ||
      ::bind(socket.fd.get(), at.get(), at.size) != 0)
    return std::unexpected(bind_problem(at, errno));
  ReceiveBatch::prepare(socket.fd.get(), at.family(), false);
  socket.local = local_address(socket.fd.get());
  return socket;
}

}  // namespace

std::expected<UdpSocket, std::string> bind_udp(const SocketAddress& at, bool local_wanted) {
  UdpSocket socket{open_udp(at.family()), {}};
  if (!socket.fd.open()) return std::unexpected(bind_problem(at, errno));
  if (::bind(socket.fd.get(), at.get(), at.size) != 0) return std::unexpected(bind_problem(at, errno));
  ReceiveBatch::prepare(socket.fd.get(), at.family(), local_wanted);
  socket.local = local_address(socket.fd.get());
  return socket;
}

std::expected<std::vector<UdpSocket>, std::string> bind_udp_steered(const SocketAddress& at, const Steering& steering) {
  std::vector<UdpSocket> sockets;
  if (steering.sockets == 1 && !steering.grows) {
    auto one = bind_udp(at);
    if (!one) return std::unexpected(one.error());
    sockets.push_back(std::move(*one));
    return sockets;
  }
  // A socket with SO_REUSEPORT would join those of another server of this user on the port, and change their program.
  // One without it is bound only if the port is free.
  auto probe = bind_udp(at);
  if (!probe) return std::unexpected(probe.error());
  SocketAddress where = probe->local;
  probe->fd = Fd{};
  const SteeringProgram program{steering};
  for (std::size_t i = 0; i < steering.sockets; ++i) {
    auto socket = bind_shared(where);
    if (!socket) return std::unexpected(socket.error());
    if (i == 0 && !program.attach(socket->fd.get())) return std::unexpected(bind_problem(where, errno));
    where = socket->local;
    sockets.push_back(std::move(*socket));
  }
  return sockets;
}

std::expected<UdpSocket, std::string> bind_udp_beside(const UdpSocket& socket) { return bind_shared(socket.local); }

std::expected<UdpSocket, std::string> connect_udp(const SocketAddress& to) {
  UdpSocket socket{open_udp(to.family()), {}};
  if (!socket.fd.open() || ::connect(socket.fd.get(), to.get(), to.size) != 0)
    return std::unexpected(to_text(to) + ": " + std::strerror(errno));
  ReceiveBatch::prepare(socket.fd.get(), to.family(), false);
  socket.local = local_address(socket.fd.get());
  return socket;
}

UdpSocket duplicate(const UdpSocket& socket) noexcept {
  return {Fd{::fcntl(socket.fd.get(), F_DUPFD_CLOEXEC, 0)}, socket.local};
}

std::expected<TcpListener, std::string> listen_tcp(const SocketAddress& at) {
  TcpListener listener{Fd{::socket(at.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)}, {}};
  const int yes = 1;
  if (!listener.fd.open() || ::setsockopt(listener.fd.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(listener.fd.get(), at.get(), at.size) != 0 || ::listen(listener.fd.get(), kBacklog) != 0)
    return std::unexpected("TCP " + bind_problem(at, errno));
  listener.local = local_address(listener.fd.get());
  return listener;
}

}  // namespace tandem::io
