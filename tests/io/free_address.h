#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace tandem::test {

/// Whether a socket of this kind can be bound to this port of loopback.
inline bool is_free(int kind, std::uint16_t port) {
  const int socket = ::socket(AF_INET, kind | SOCK_CLOEXEC, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(port);
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool bound = socket >= 0 && ::bind(socket, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0;
  if (socket >= 0) ::close(socket);
  return bound;
}

/// A free loopback address, because a restarted server must have the same one. It is below the kernel's range of
/// ephemeral ports: otherwise another test could get it while no server runs.
inline std::string free_address() {
  constexpr int kFirst = 20000, kPorts = 12000;
  static int next = 0;  // not the one of the last call
  for (int i = 0; i < kPorts; ++i, ++next) {
    const auto port = static_cast<std::uint16_t>(kFirst + (7 * ::getpid() + next) % kPorts);
    if (!is_free(SOCK_DGRAM, port) || !is_free(SOCK_STREAM, port)) continue;
    ++next;
    return "127.0.0.1:" + std::to_string(port);
  }
  throw std::runtime_error("no free port");
}

}  // namespace tandem::test
