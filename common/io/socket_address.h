#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>

namespace tandem::io {

/// An IPv4 or IPv6 address with port, comparable and without padding.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;

  [[nodiscard]] const sockaddr* get() const noexcept;
  [[nodiscard]] int family() const noexcept { return storage.ss_family; }
  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] bool any() const noexcept;       ///< 0.0.0.0 or ::
  [[nodiscard]] bool loopback() const noexcept;  ///< 127.0.0.0/8, ::1
};

/// What tells two peers apart: family, address, scope, port.
struct PeerKey {
  std::uint64_t a = 0, b = 0, c = 0;
  [[nodiscard]] static PeerKey of(const sockaddr_storage& address) noexcept;
  friend bool operator==(const PeerKey&, const PeerKey&) = default;
};

/// Reads `HOST:PORT`, `[IPV6]:PORT`, `localhost:PORT`. Of a name with several addresses the first IPv4 one counts.
/// @param port_min  least port allowed: 0 where a free one may be chosen
/// @return the address, or what is wrong with it
[[nodiscard]] std::expected<SocketAddress, std::string> parse_address(std::string_view text, unsigned port_min);

/// `127.0.0.1:7000`, `[::1]:7000`.
[[nodiscard]] std::string to_text(const SocketAddress& address);
[[nodiscard]] std::string to_text(const sockaddr_storage& address);

}  // namespace tandem::io
