#pragma once

#include <cstring>

#include "common/io/socket_address.h"
#include "server/session/seat_endpoint.h"

namespace tandem::server {

/// Address of a peer for the session code: only the meaningful bytes of the socket address, so that equal peers have
/// equal bytes.
[[nodiscard]] inline PeerAddress endpoint_of(const sockaddr_storage& from) noexcept {
  PeerAddress e;
  if (from.ss_family == AF_INET6) {
    static_assert(sizeof(sockaddr_in6) == sizeof e.bytes);
    sockaddr_in6 v6;
    std::memcpy(&v6, &from, sizeof v6);
    v6.sin6_flowinfo = 0;
    std::memcpy(e.bytes.data(), &v6, sizeof v6);
    e.size = sizeof v6;
  } else {
    sockaddr_in v4;
    std::memcpy(&v4, &from, sizeof v4);
    std::memset(v4.sin_zero, 0, sizeof v4.sin_zero);
    std::memcpy(e.bytes.data(), &v4, sizeof v4);
    e.size = sizeof v4;
  }
  return e;
}

[[nodiscard]] inline io::SocketAddress address_of(const PeerAddress& e) noexcept {
  io::SocketAddress address;
  std::memcpy(&address.storage, e.bytes.data(), e.size);
  address.size = e.size;
  return address;
}

}  // namespace tandem::server
