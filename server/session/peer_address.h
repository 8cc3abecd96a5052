#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tandem::server {

/// Bytes of a socket address, opaque to the session code.
struct PeerAddress {
  std::array<std::byte, 28> bytes{};
  std::uint8_t size = 0;
  // One memcmp, because every datagram is compared.
  friend bool operator==(const PeerAddress& a, const PeerAddress& b) noexcept {
    return a.size == b.size && std::memcmp(a.bytes.data(), b.bytes.data(), sizeof a.bytes) == 0;
  }
};

/// Destination and size of a datagram to send.
struct Transmit {
  PeerAddress to;
  std::size_t size = 0;
};

}  // namespace tandem::server
