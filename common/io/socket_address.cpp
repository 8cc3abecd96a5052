#include "common/io/socket_address.h"

#include <arpa/inet.h>
#include <netdb.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>

namespace tandem::io {
namespace {

template <typename T>
T as(const sockaddr_storage& storage) noexcept {
  T address;
  std::memcpy(&address, &storage, sizeof address);
  return address;
}

}  // namespace

const sockaddr* SocketAddress::get() const noexcept {
  return reinterpret_cast<const sockaddr*>(&storage);  // the socket interface is designed for this cast
}

std::uint16_t SocketAddress::port() const noexcept {
  return ntohs(family() == AF_INET6 ? as<sockaddr_in6>(storage).sin6_port : as<sockaddr_in>(storage).sin_port);
}

bool SocketAddress::any() const noexcept {
  if (family() == AF_INET) return as<sockaddr_in>(storage).sin_addr.s_addr == htonl(INADDR_ANY);
  const auto v6 = as<sockaddr_in6>(storage);
  return IN6_IS_ADDR_UNSPECIFIED(&v6.sin6_addr);
}

bool SocketAddress::loopback() const noexcept {
  if (family() == AF_INET) return (ntohl(as<sockaddr_in>(storage).sin_addr.s_addr) >> 24) == IN_LOOPBACKNET;
  const auto v6 = as<sockaddr_in6>(storage);
  return family() == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&v6.sin6_addr);
}

PeerKey PeerKey::of(const sockaddr_storage& address) noexcept {
  PeerKey key;
  if (address.ss_family == AF_INET6) {
    const auto v6 = as<sockaddr_in6>(address);
    std::memcpy(&key.a, v6.sin6_addr.s6_addr, 8);
    std::memcpy(&key.b, v6.sin6_addr.s6_addr + 8, 8);
    key.c = (std::uint64_t{v6.sin6_scope_id} << 32) | (std::uint64_t{v6.sin6_port} << 16) | AF_INET6;
  } else {
    const auto v4 = as<sockaddr_in>(address);
    key.a = v4.sin_addr.s_addr;
    key.c = (std::uint64_t{v4.sin_port} << 16) | AF_INET;
  }
  return key;
}

namespace {

/// @param flags  AI_NUMERICHOST: asks no DNS server; 0: may ask one
std::expected<std::vector<SocketAddress>, std::string> resolve(std::string_view text, unsigned port_min, int flags) {
  const auto wrong = [text](const std::string& why) {
    return std::unexpected("\"" + std::string(text) + "\": " + why);
  };
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) return wrong("needs HOST:PORT, such as 127.0.0.1:7000");
  std::string_view host = text.substr(0, colon);
  const std::string_view port_text = text.substr(colon + 1);
  unsigned port = 0;
  const auto [end, error] = std::from_chars(port_text.data(), port_text.data() + port_text.size(), port);
  if (error != std::errc{} || end != port_text.data() + port_text.size() || port < port_min || port > 65535) {
    return wrong("the port must be a whole number in [" + std::to_string(port_min) + ", 65535]");
  }
  if (host.size() >= 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return wrong("an IPv6 address needs brackets, such as [::1]:7000");
  }
  if (host.empty()) return wrong("the host is missing, such as 127.0.0.1 or [::1]");

  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = AI_NUMERICSERV | flags;
  addrinfo* found = nullptr;
  const int failed = getaddrinfo(std::string(host).c_str(), std::to_string(port).c_str(), &hints, &found);
  if (failed != 0) return wrong(std::string("no address for this host: ") + gai_strerror(failed));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner{found, &freeaddrinfo};
  std::vector<SocketAddress> addresses;
  for (const int family : {AF_INET, AF_INET6}) {
    for (const addrinfo* candidate = found; candidate != nullptr; candidate = candidate->ai_next) {
      if (candidate->ai_family != family) continue;
      SocketAddress address;
      address.size = std::min<socklen_t>(candidate->ai_addrlen, sizeof address.storage);
      std::memcpy(&address.storage, candidate->ai_addr, address.size);
      const PeerKey key = PeerKey::of(address.storage);
      if (std::ranges::none_of(addresses, [&](const SocketAddress& a) { return PeerKey::of(a.storage) == key; }))
        addresses.push_back(address);
    }
  }
  if (addresses.empty()) return wrong("this host has neither an IPv4 nor an IPv6 address");
  return addresses;
}

}  // namespace

std::expected<std::vector<SocketAddress>, std::string> resolve_addresses(std::string_view text, unsigned port_min) {
  return resolve(text, port_min, 0);
}

std::optional<SocketAddress> numeric_address(std::string_view text, unsigned port_min) {
  const auto addresses = resolve(text, port_min, AI_NUMERICHOST);
  return addresses ? std::optional(addresses->front()) : std::nullopt;
}

std::expected<SocketAddress, std::string> parse_address(std::string_view text, unsigned port_min) {
  auto addresses = resolve_addresses(text, port_min);
  if (!addresses) return std::unexpected(std::move(addresses.error()));
  return addresses->front();
}

std::string to_text(const sockaddr_storage& address) {
  char host[INET6_ADDRSTRLEN + 1] = "?";
  if (address.ss_family == AF_INET6) {
    const auto v6 = as<sockaddr_in6>(address);
    inet_ntop(AF_INET6, &v6.sin6_addr, host, sizeof host);
    return "[" + std::string(host) + "]:" + std::to_string(ntohs(v6.sin6_port));
  }
  const auto v4 = as<sockaddr_in>(address);
  inet_ntop(AF_INET, &v4.sin_addr, host, sizeof host);
  return std::string(host) + ":" + std::to_string(ntohs(v4.sin_port));
}

std::string to_text(const SocketAddress& address) { return to_text(address.storage); }

}  // namespace tandem::io
