#include "netsim/proxy/app/proxy_clients.h"

#include <linux/sock_diag.h>
#include <sys/epoll.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/io/udp_socket.h"

namespace tandem::netsim {
namespace {

io::Fd udp(int family) noexcept { return io::Fd{::socket(family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)}; }

void reuse(int fd, bool on) noexcept {
  const int value = on ? 1 : 0;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &value, sizeof value);
}

/// Enables stamps and buffers. Per-datagram drop reports are disabled; drops are queried instead.
void prepare(int fd, int family, bool local, int buffer_bytes) noexcept {
  io::ReceiveBatch::prepare(fd, family, local, buffer_bytes);
  const int off = 0;
  setsockopt(fd, SOL_SOCKET, SO_RXQ_OVFL, &off, sizeof off);
}

io::SocketAddress address_of(const sockaddr_storage& address) noexcept {
  io::SocketAddress peer;
  peer.storage = address;
  peer.size = peer.family() == AF_INET6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in);
  return peer;
}

/// Returns whether two addresses are equal except for the port.
bool same_host(const sockaddr_storage& a, const sockaddr_storage& b) noexcept {
  if (a.ss_family != b.ss_family) return false;
  if (a.ss_family == AF_INET6) {
    const auto* const x = reinterpret_cast<const sockaddr_in6*>(&a);
    const auto* const y = reinterpret_cast<const sockaddr_in6*>(&b);
    return std::memcmp(&x->sin6_addr, &y->sin6_addr, sizeof x->sin6_addr) == 0 && x->sin6_scope_id == y->sin6_scope_id;
  }
  return reinterpret_cast<const sockaddr_in*>(&a)->sin_addr.s_addr ==
         reinterpret_cast<const sockaddr_in*>(&b)->sin_addr.s_addr;
}

std::uint64_t drops_of(const io::Fd& fd) noexcept {
  std::array<std::uint32_t, SK_MEMINFO_VARS> numbers{};
  socklen_t size = sizeof numbers;
  if (!fd.open() || getsockopt(fd.get(), SOL_SOCKET, SO_MEMINFO, numbers.data(), &size) != 0) return 0;
  return numbers[SK_MEMINFO_DROPS];
}

}  // namespace

std::expected<ProxyClients, std::string> ProxyClients::open(const io::SocketAddress& listen,
                                                            const io::SocketAddress& to) {
  auto socket = io::bind_udp(listen, listen.any());
  if (!socket) return std::unexpected(socket.error());
  ProxyClients clients;
  clients.listen_ = std::move(socket->fd);
  prepare(clients.listen_.get(), listen.family(), listen.any(), io::ReceiveBatch::kBufferBytes);
  clients.listening_ = socket->local;
  clients.to_ = to;
  clients.poll_ = io::Fd{epoll_create1(EPOLL_CLOEXEC)};
  if (!clients.poll_.open() || !clients.watch(clients.listen_.get(), {ProxySource::Kind::kListen, 0})) {
    return std::unexpected(std::string("the system gives no file descriptors: ") + std::strerror(errno));
  }
  return clients;
}

int ProxyClients::fd_of(ProxySource source) const noexcept {
  switch (source.kind) {
    case ProxySource::Kind::kListen:
      return listen_.get();
    case ProxySource::Kind::kDownside:
      return clients_[source.place].downside.get();
    case ProxySource::Kind::kUpside:
      return clients_[source.place].upside.get();
    case ProxySource::Kind::kFormer:
      return clients_[source.place].former.get();
    case ProxySource::Kind::kWake:
      break;
  }
  return -1;
}

std::optional<std::uint32_t> ProxyClients::find(const io::PeerKey& key) const noexcept {
  for (std::size_t at = hash(key); table_[at] != 0; at = (at + 1) % kTable) {
    const std::uint32_t place = table_[at] - 1U;
    if (clients_[place].key == key) return place;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> ProxyClients::find_silent(const sockaddr_storage& address,
                                                       Duration silent_since) const noexcept {
  for (std::uint32_t place = 0; place < kMax; ++place) {
    const Client& client = clients_[place];
    if (client.present && client.last_heard <= silent_since && same_host(client.address.storage, address)) return place;
  }
  return std::nullopt;
}

bool ProxyClients::move(std::uint32_t place, const io::PeerKey& key, const sockaddr_storage& address,
                        const io::LocalAddress& local) noexcept {
  const io::SocketAddress peer = address_of(address);
  io::Fd down = connect_downside(peer, local);
  if (!down.open()) return false;
  Client& client = clients_[place];
  client.kernel_drops += drops_of(client.downside);
  client.downside = std::move(down);
  client.address = peer;
  client.key = key;
  pending_[pending_count_++] = place;
  index();
  return true;
}

bool ProxyClients::add(std::uint32_t place, std::uint64_t number, const io::PeerKey& key,
                       const sockaddr_storage& address, const io::LocalAddress& local) noexcept {
  const io::SocketAddress peer = address_of(address);
  io::Fd down = connect_downside(peer, local);
  io::Fd up = connect_upside();
  if (!down.open() || !up.open() || !watch(up.get(), {ProxySource::Kind::kUpside, place})) return false;
  Client& client = clients_[place];
  client = {.downside = std::move(down),
            .upside = std::move(up),
            .former = {},
            .address = peer,
            .key = key,
            .number = number,
            .present = true};
  pending_[pending_count_++] = place;
  index();
  return true;
}

void ProxyClients::remove(std::uint32_t place) noexcept {
  for (std::uint32_t i = 0; i < pending_count_; ++i) {
    if (pending_[i] == place) pending_[i--] = pending_[--pending_count_];
  }
  clients_[place] = Client{};  // closing removes the sockets from epoll
  index();
}

bool ProxyClients::change_address(std::uint32_t place, std::uint32_t number) noexcept {
  Client& client = clients_[place];
  io::Fd up = connect_upside();
  if (!up.open()) return false;
  if (!watch(client.upside.get(), {ProxySource::Kind::kFormer, place}, EPOLL_CTL_MOD) ||
      !watch(up.get(), {ProxySource::Kind::kUpside, place})) {
    return false;
  }
  close_former(place);
  client.former = std::exchange(client.upside, std::move(up));
  client.former_number = std::exchange(client.address_number, number);
  return true;
}

void ProxyClients::close_former(std::uint32_t place) noexcept {
  Client& client = clients_[place];
  client.kernel_drops += drops_of(client.former);
  client.former.reset();
}

std::uint64_t ProxyClients::kernel_drops(std::uint32_t place) const noexcept {
  const Client& client = clients_[place];
  return client.kernel_drops + drops_of(client.downside) + drops_of(client.upside) + drops_of(client.former);
}

std::uint64_t ProxyClients::kernel_drops() const noexcept { return drops_of(listen_); }

void ProxyClients::listen_to_pending() noexcept {
  for (std::uint32_t i = 0; i < pending_count_; ++i) {
    watch(clients_[pending_[i]].downside.get(), {ProxySource::Kind::kDownside, pending_[i]});
  }
  pending_count_ = 0;
}

bool ProxyClients::watch(int fd, ProxySource source) noexcept { return watch(fd, source, EPOLL_CTL_ADD); }

bool ProxyClients::watch(int fd, ProxySource source, int operation) noexcept {
  epoll_event event{.events = EPOLLIN, .data = {.u64 = source.as_number()}};
  return epoll_ctl(poll_.get(), operation, fd, &event) == 0;
}

io::Fd ProxyClients::connect_downside(const io::SocketAddress& address, const io::LocalAddress& local) noexcept {
  io::SocketAddress ours = listening_;
  if (local.family == AF_INET) {
    std::memcpy(reinterpret_cast<char*>(&ours.storage) + offsetof(sockaddr_in, sin_addr), &local.v4, sizeof local.v4);
  } else if (local.family == AF_INET6) {
    std::memcpy(reinterpret_cast<char*>(&ours.storage) + offsetof(sockaddr_in6, sin6_addr), &local.v6, sizeof local.v6);
    if (IN6_IS_ADDR_LINKLOCAL(&local.v6)) {
      std::memcpy(reinterpret_cast<char*>(&ours.storage) + offsetof(sockaddr_in6, sin6_scope_id),
                  &local.interface_index, sizeof local.interface_index);
    }
  }
  io::Fd fd = udp(ours.family());
  if (!fd.open()) return {};
  // The port is shareable only during this call, so that a second proxy on the same port gets an error.
  share_port(true);
  reuse(fd.get(), true);
  const bool bound =
      ::bind(fd.get(), ours.get(), ours.size) == 0 && ::connect(fd.get(), address.get(), address.size) == 0;
  reuse(fd.get(), false);
  share_port(false);
  if (!bound) return {};
  prepare(fd.get(), ours.family(), false, kBufferBytes);
  return fd;
}

io::Fd ProxyClients::connect_upside() noexcept {
  io::Fd fd = udp(to_.family());
  if (!fd.open() || ::connect(fd.get(), to_.get(), to_.size) != 0) return {};
  prepare(fd.get(), to_.family(), false, kBufferBytes);
  return fd;
}

void ProxyClients::share_port(bool on) noexcept {
  reuse(listen_.get(), on);
  for (const Client& client : clients_) {
    if (client.downside.open()) reuse(client.downside.get(), on);
  }
}

void ProxyClients::index() noexcept {
  table_.fill(0);
  for (std::uint32_t place = 0; place < kMax; ++place) {
    if (!clients_[place].present) continue;
    std::size_t at = hash(clients_[place].key);
    while (table_[at] != 0) at = (at + 1) % kTable;
    table_[at] = static_cast<std::uint8_t>(place + 1);
  }
}

std::size_t ProxyClients::hash(const io::PeerKey& key) noexcept {
  std::uint64_t x = key.a ^ (key.b * 0x9E3779B97F4A7C15U) ^ (key.c * 0xBF58476D1CE4E5B9U);
  x ^= x >> 31;
  x *= 0x94D049BB133111EBU;
  return static_cast<std::size_t>(x >> 56) % kTable;
}

}  // namespace tandem::netsim
