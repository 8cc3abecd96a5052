#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tandem::server {

/// Bytes of a socket address, opaque to the session code.
struct PeerAddress {
  std::array<std::byte, 28> bytes{};
  std::uint8_t size = 0;
  std::array<std::byte, 3> unused{};  ///< 32 bytes without gaps, which are compared and copied for each datagram
  friend bool operator==(const PeerAddress& a, const PeerAddress& b) noexcept {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
};
static_assert(std::has_unique_object_representations_v<PeerAddress>);

/// Destination and size of a datagram to send.
struct Transmit {
  PeerAddress to;
  std::size_t size = 0;
};

}  // namespace tandem::server
