#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tandem::server {

/// Where somebody is: the bytes of a socket address, opaque to cores.
struct Endpoint {
  std::array<std::byte, 28> bytes{};
  std::uint8_t size = 0;
  friend bool operator==(const Endpoint& a, const Endpoint& b) noexcept {  // the bytes at once: asked for every datagram
    return a.size == b.size && std::memcmp(a.bytes.data(), b.bytes.data(), sizeof a.bytes) == 0;
  }
};

/// A datagram that is due, and where it goes.
struct Transmit {
  Endpoint to;
  std::size_t size = 0;
};

}  // namespace tandem::server
