#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::io {

/// An IPv4 or IPv6 address with port; comparable, without padding.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;

  [[nodiscard]] const sockaddr* get() const noexcept;
  [[nodiscard]] int family() const noexcept { return storage.ss_family; }
  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] bool any() const noexcept;       ///< 0.0.0.0 or ::
  [[nodiscard]] bool loopback() const noexcept;  ///< 127.0.0.0/8, ::1
};

/// Key that distinguishes peers: family, address, scope, port.
struct PeerKey {
  std::uint64_t a = 0, b = 0, c = 0;
  [[nodiscard]] static PeerKey of(const sockaddr_storage& address) noexcept;
  friend bool operator==(const PeerKey&, const PeerKey&) = default;
};

/// Parses `HOST:PORT`, `[IPV6]:PORT`, `localhost:PORT`. @return all addresses of the name, IPv4 first, each once, or
/// the error. It may block for 20 s while a DNS server does not answer (common/io/name_resolver.h).
[[nodiscard]] std::expected<std::vector<SocketAddress>, std::string> resolve_addresses(std::string_view text,
                                                                                       unsigned port_min);
/// Returns the address of `HOST:PORT` if HOST is an address; nullopt if it is a name, or invalid. Asks no DNS server.
[[nodiscard]] std::optional<SocketAddress> numeric_address(std::string_view text, unsigned port_min);
/// Parses `HOST:PORT`, `[IPV6]:PORT`, `localhost:PORT`. Of a name with several addresses it returns the first IPv4 one.
/// @param port_min  smallest allowed port: 0 where the system may choose a free one
/// @return the address, or the error
[[nodiscard]] std::expected<SocketAddress, std::string> parse_address(std::string_view text, unsigned port_min);

/// Returns text such as `127.0.0.1:7000`, `[::1]:7000`.
[[nodiscard]] std::string to_text(const SocketAddress& address);
[[nodiscard]] std::string to_text(const sockaddr_storage& address);

}  // namespace tandem::io
