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
#include "netsim/proxy/proxy_core.h"

namespace tandem::netsim {

/// Origin of an event: a socket of the proxy, or its wake-up descriptor.
struct ProxySource {
  enum class Kind : std::uint8_t {
    kListen,    ///< listening socket, for unknown senders
    kDownside,  ///< one client's socket towards the client
    kUpside,    ///< one client's socket towards the server
    kFormer,    ///< kUpside before the client's address changed
    kWake,      ///< wake-up descriptor: another thread needs the packet thread
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

/// Clients of a proxy and their sockets. Each client has two sockets: one bound to the listening address and connected
/// to the client, one connected to the server. A flooding client therefore fills only its own kernel buffer, the server
/// can distinguish clients, and the system reports closed ports. Reading and sending allocate nothing; adding and
/// removing clients opens and closes sockets.
class ProxyClients {
 public:
  static constexpr std::uint32_t kMax = ProxyCore::kClientsMax;
  static constexpr int kBufferBytes = 1 << 20;  ///< per socket: about 2500 small datagrams

  /// Sockets and addresses of one client.
  struct Client {
    Duration arrived{};  ///< time of arrival since the proxy's start
    io::Fd downside, upside;
    io::Fd former;                     ///< `upside` before the client's address changed
    std::uint32_t address_number = 0;  ///< address number of `upside`, as counted by ProxyCore
    std::uint32_t former_number = 0;
    io::SocketAddress address;
    io::PeerKey key;
    std::uint64_t number = 0;  ///< by order of arrival, from 1
    Duration last_seen{};
    Duration last_heard{};  ///< last datagram from the client itself
    bool present = false;
    std::uint64_t kernel_drops = 0;  ///< of sockets closed earlier
  };

  /// Binds the listening socket. Returns the clients, or an error with a remedy.
  [[nodiscard]] static std::expected<ProxyClients, std::string> open(const io::SocketAddress& listen,
                                                                     const io::SocketAddress& to);

  [[nodiscard]] const io::SocketAddress& listening() const noexcept { return listening_; }
  [[nodiscard]] int listen_fd() const noexcept { return listen_.get(); }
  [[nodiscard]] int poll_fd() const noexcept { return poll_.get(); }
  [[nodiscard]] Client& operator[](std::uint32_t place) noexcept { return clients_[place]; }
  [[nodiscard]] const Client& operator[](std::uint32_t place) const noexcept { return clients_[place]; }
  [[nodiscard]] int fd_of(ProxySource source) const noexcept;

  /// Returns the place of the client with this address.
  [[nodiscard]] std::optional<std::uint32_t> find(const io::PeerKey& key) const noexcept;
  /// Creates the sockets of a new client in a free place.
  /// @param local  local address to which the client sent
  /// @return whether the system provided the sockets
  bool add(std::uint32_t place, std::uint64_t number, const io::PeerKey& key, const sockaddr_storage& address,
           const io::LocalAddress& local) noexcept;
  /// Returns the first silent client of the same host. A datagram from another port of that host is taken as a
  /// reconnect of this client.
  /// @param silent_since  the client has sent nothing after this time
  [[nodiscard]] std::optional<std::uint32_t> find_silent(const sockaddr_storage& address,
                                                         Duration silent_since) const noexcept;
  /// Moves a client to its new address; it keeps its place, number and network. Returns whether the system provided the
  /// socket.
  bool move(std::uint32_t place, const io::PeerKey& key, const sockaddr_storage& address,
            const io::LocalAddress& local) noexcept;
  void remove(std::uint32_t place) noexcept;
  /// Gives the client its `number`-th address as seen by the server. The old socket still receives until it is closed.
  bool change_address(std::uint32_t place, std::uint32_t number) noexcept;
  void close_former(std::uint32_t place) noexcept;

  /// Number of datagrams dropped by the kernel because a buffer was full: of one client, and of all unknown senders.
  [[nodiscard]] std::uint64_t kernel_drops(std::uint32_t place) const noexcept;
  [[nodiscard]] std::uint64_t kernel_drops() const noexcept;

  /// Returns the clients whose sockets towards them are not polled yet.
  [[nodiscard]] std::span<const std::uint32_t> pending() const noexcept { return {pending_.data(), pending_count_}; }
  /// Starts polling these sockets, after datagrams that arrived earlier on other sockets were read.
  void listen_to_pending() noexcept;

  bool watch(int fd, ProxySource source) noexcept;

 private:
  static constexpr std::size_t kTable = 256;  ///< four times the clients, for short probe sequences
  static_assert(kTable >= 4 * std::size_t{kMax} && kMax < 255);

  [[nodiscard]] io::Fd connect_downside(const io::SocketAddress& address, const io::LocalAddress& local) noexcept;
  [[nodiscard]] io::Fd connect_upside() noexcept;
  bool watch(int fd, ProxySource source, int operation) noexcept;
  void share_port(bool on) noexcept;
  void index() noexcept;
  [[nodiscard]] static std::size_t hash(const io::PeerKey& key) noexcept;

  io::Fd listen_, poll_;
  io::SocketAddress listening_, to_;
  std::array<Client, kMax> clients_;
  std::array<std::uint8_t, kTable> table_{};  ///< place + 1; 0: empty
  std::array<std::uint32_t, kMax> pending_{};
  std::uint32_t pending_count_ = 0;
};

}  // namespace tandem::netsim
