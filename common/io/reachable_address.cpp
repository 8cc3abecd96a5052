#include "common/io/reachable_address.h"

#include <ifaddrs.h>
#include <net/if.h>

#include <cstring>
#include <memory>
#include <optional>

#include "common/io/fd.h"

namespace tandem::io {
namespace {

SocketAddress with_port(const sockaddr* address, socklen_t size, std::uint16_t port) {
  SocketAddress out;
  std::memcpy(&out.storage, address, size);
  out.size = size;
  const std::uint16_t big = htons(port);
  if (out.family() == AF_INET6) {
    reinterpret_cast<sockaddr_in6*>(&out.storage)->sin6_port = big;
  } else {
    reinterpret_cast<sockaddr_in*>(&out.storage)->sin_port = big;
  }
  return out;
}

/// Returns whether an address works on every network without an interface name.
bool reachable_from_outside(const SocketAddress& a) {
  if (a.any() || a.loopback()) return false;
  return a.family() != AF_INET6 ||
         !IN6_IS_ADDR_LINKLOCAL(&reinterpret_cast<const sockaddr_in6*>(&a.storage)->sin6_addr);
}

/// Returns the address of this machine towards other networks. Nothing is sent: `far` is an address reserved for
/// documentation.
std::optional<SocketAddress> towards(const char* far, std::uint16_t port) {
  const auto peer = parse_address(far, 0);
  if (!peer) return std::nullopt;
  const Fd socket{::socket(peer->family(), SOCK_DGRAM | SOCK_CLOEXEC, 0)};
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  if (!socket.open() || ::connect(socket.get(), peer->get(), peer->size) != 0 ||
      ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&own), &size) != 0)
    return std::nullopt;
  const SocketAddress found = with_port(reinterpret_cast<const sockaddr*>(&own), size, port);
  return reachable_from_outside(found) ? std::optional{found} : std::nullopt;
}

std::optional<SocketAddress> of_an_interface(int family, std::uint16_t port) {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all{list, ::freeifaddrs};
  for (const ifaddrs* i = list; i != nullptr; i = i->ifa_next) {
    if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != family || (i->ifa_flags & IFF_UP) == 0) continue;
    const SocketAddress found =
        with_port(i->ifa_addr, family == AF_INET6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in), port);
    if (reachable_from_outside(found)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::string reachable_address(const SocketAddress& at) {
  if (!at.any()) return to_text(at);
  const bool v6 = at.family() == AF_INET6;
  std::optional<SocketAddress> found;
  if (v6) found = towards("[2001:db8::1]:9", at.port());
  if (!found && v6) found = of_an_interface(AF_INET6, at.port());
  if (!found) found = towards("192.0.2.1:9", at.port());  // a listener at [::] also receives IPv4
  if (!found) found = of_an_interface(AF_INET, at.port());
  return found ? to_text(*found) : (v6 ? "[::1]:" : "127.0.0.1:") + std::to_string(at.port());
}

std::string only_here_note(const SocketAddress& at, const std::string& reachable) {
  const auto address = parse_address(reachable, 0);
  if (!at.any() || !address || !address->loopback()) return {};
  return "this computer has no address in a network yet: commands with " + reachable +
         " work here only; on other computers put its name or address in front of :" + std::to_string(at.port());
}

std::string reachable_address(const std::string& at) {
  const auto address = parse_address(at, 0);
  return address ? reachable_address(*address) : at;
}

}  // namespace tandem::io
