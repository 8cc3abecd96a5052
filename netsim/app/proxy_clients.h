#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>

#include "common/base/time.h"
#include "common/io/datagram_batch.h"
#include "common/io/fd.h"
#include "common/io/socket_address.h"
#include "netsim/proxy_core.h"

namespace tandem::netsim {

/// Which socket of the proxy something came from.
struct ProxySource {
  enum class Kind : std::uint8_t {
    kListen,    ///< where strangers knock
    kDownside,  ///< of one client, towards it
    kUpside,    ///< of one client, towards the server
    kFormer,    ///< the same before the client's address changed
    kWake,      ///< not a socket: somebody wants the packet thread's attention
  };
  static constexpr std::size_t kKinds = 5;
  Kind kind = Kind::kListen;
  std::uint32_t place = 0;

  [[nodiscard]] std::uint64_t as_number() const noexcept {
    return (std::uint64_t{place} << 3) | static_cast<unsigned>(kind);
  }
  [[nodiscard]] static ProxySource of(std::uint64_t number) noexcept {
    return {static_cast<Kind>(number & 7), static_cast<std::uint32_t>(number >> 3)};
  }
};

/// The clients of a proxy and their sockets. Each has two of its own: one bound to the listening address and connected
/// to the client, one connected to the server. So a client that floods fills its own buffer in the kernel, not that of
/// the others, the server tells clients apart, and "nobody listens there" is told by the system. Reading and sending
/// take no memory; welcoming and forgetting make and close sockets.
class ProxyClients {
 public:
  static constexpr std::uint32_t kMax = ProxyCore::kClientsMax;
  static constexpr int kBufferBytes = 1 << 20;  ///< of each socket: about 2500 small datagrams

  struct Client {
    Duration came{};  ///< since the proxy's start
    io::Fd downside, upside;
    io::Fd former;                     ///< `upside` before the client's address changed
    std::uint32_t address_number = 0;  ///< of `upside`; ProxyCore counts a client's addresses
    std::uint32_t former_number = 0;
    io::SocketAddress address;
    io::PeerKey key;
    std::uint64_t number = 0;  ///< in order of arrival, from 1
    Duration last_seen{};
    Duration last_heard{};     ///< from the client itself
    bool present = false;
    std::uint64_t kernel_drops = 0;  ///< of sockets it has no more
  };

  /// Binds the listening socket. @return what went wrong and what to do about it
  [[nodiscard]] static std::expected<ProxyClients, std::string> open(const io::SocketAddress& listen,
                                                                     const io::SocketAddress& to);

  [[nodiscard]] const io::SocketAddress& listening() const noexcept { return listening_; }
  [[nodiscard]] int listen_fd() const noexcept { return listen_.get(); }
  [[nodiscard]] int poll_fd() const noexcept { return poll_.get(); }
  [[nodiscard]] Client& operator[](std::uint32_t place) noexcept { return clients_[place]; }
  [[nodiscard]] const Client& operator[](std::uint32_t place) const noexcept { return clients_[place]; }
  [[nodiscard]] int fd_of(ProxySource source) const noexcept;

  /// Whose address this is.
  [[nodiscard]] std::optional<std::uint32_t> find(const io::PeerKey& key) const noexcept;
  /// Makes the sockets of a new client in a free place.
  /// @param local  the address of ours it called
  /// @return whether the system gave them
  bool welcome(std::uint32_t place, std::uint64_t number, const io::PeerKey& key, const sockaddr_storage& address,
               const io::LocalAddress& local) noexcept;
  /// A client of the same host that fell silent: who calls from another port of that host now is the same one, come back.
  /// @param silent_since  it was not heard after that  @return the first of them
  [[nodiscard]] std::optional<std::uint32_t> silent_from(const sockaddr_storage& address, Duration silent_since) const noexcept;
  /// The client calls from another address now, and keeps its place, number and network. @return whether the system gave the socket
  bool move(std::uint32_t place, const io::PeerKey& key, const sockaddr_storage& address, const io::LocalAddress& local) noexcept;
  void forget(std::uint32_t place) noexcept;
  /// From now on the server sees the client at a new address, its `number`th; the old one is heard until it is closed.
  bool change_address(std::uint32_t place, std::uint32_t number) noexcept;
  void close_former(std::uint32_t place) noexcept;

  /// Datagrams the kernel dropped because a buffer was full: the client's so far, all strangers' so far.
  [[nodiscard]] std::uint64_t kernel_drops(std::uint32_t place) const noexcept;
  [[nodiscard]] std::uint64_t kernel_drops() const noexcept;

  /// Clients whose sockets towards them are not listened to yet.
  [[nodiscard]] std::span<const std::uint32_t> newcomers() const noexcept { return {newcomer_.data(), newcomers_}; }
  /// What came before they had sockets of their own was read: listen to these from now on.
  void listen_to_newcomers() noexcept;

  bool watch(int fd, ProxySource source) noexcept;

 private:
  static constexpr std::size_t kTable = 256;  ///< four times the clients: short ways
  static_assert(kTable >= 4 * kMax && kMax < 255);

  [[nodiscard]] io::Fd connect_downside(const io::SocketAddress& address, const io::LocalAddress& local) noexcept;
  [[nodiscard]] io::Fd connect_upside() noexcept;
  void share_port(bool on) noexcept;
  void index() noexcept;
  [[nodiscard]] static std::size_t hash(const io::PeerKey& key) noexcept;

  io::Fd listen_, poll_;
  io::SocketAddress listening_, to_;
  std::array<Client, kMax> clients_;
  std::array<std::uint8_t, kTable> table_{};  ///< place + 1; 0: empty
  std::array<std::uint32_t, kMax> newcomer_{};
  std::uint32_t newcomers_ = 0;
};

}  // namespace tandem::netsim
