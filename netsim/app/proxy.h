#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <expected>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "common/io/datagram_batch.h"
#include "common/io/fd.h"
#include "common/io/socket_address.h"
#include "netsim/path_spec.h"
#include "netsim/proxy_core.h"

namespace tandem::netsim {

struct ProxyOptions {
  io::SocketAddress listen;
  io::SocketAddress to;
  LinkSpec link;
  std::uint64_t seed = 1;
  Duration duration{};                  ///< 0: until told to stop
  Duration idle_limit{60'000'000'000};  ///< a client without a datagram for so long is forgotten
};

/// What the proxy met besides the network it plays.
struct ProxyTroubles {
  std::uint64_t too_many_clients = 0;  ///< datagrams of clients beyond the 64th
  std::uint64_t too_long = 0;          ///< datagrams above 1500 bytes
  std::uint64_t kernel_drops = 0;      ///< the kernel's receive buffers were full
  std::uint64_t no_room = 0;           ///< the kernel's send buffers were full
  std::uint64_t refused = 0;           ///< nobody listened at the other end
  std::uint64_t other = 0;             ///< anything else a socket said
};

struct ProxyStatus {
  Duration since_start{};
  std::uint64_t clients = 0;
  std::uint64_t clients_seen = 0;
  std::array<PathCounters, kDirections> total;
  ProxyTroubles troubles;
};

struct ProxyClientReport {
  sockaddr_storage address{};
  bool present = false;
  std::array<PathCounters, kDirections> counters;
};

/// The live proxy: one thread, one socket for all clients, one connected socket per client towards the server.
/// Deadlines are absolute; datagrams are stamped by the kernel, so a late wake-up of ours does not add to the delay
/// twice.
class Proxy {
 public:
  /// Binds the listening socket. @return the proxy, or what went wrong and what to do about it
  /// @throws std::invalid_argument when the link cannot be simulated
  [[nodiscard]] static std::expected<std::unique_ptr<Proxy>, std::string> open(const ProxyOptions& options);

  /// The address that clients send to, with the port in force.
  [[nodiscard]] const io::SocketAddress& listening() const noexcept { return listening_; }

  /// Works until `stop`, or until the duration is over.
  void run();
  /// From any thread or signal handler.
  void stop() noexcept;

  /// A recent picture, from any thread.
  [[nodiscard]] ProxyStatus status() const;
  /// After `run`: everything, and how late datagrams were sent compared with their schedule.
  [[nodiscard]] ProxyStatus final_status() const { return snapshot(); }
  [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }
  [[nodiscard]] std::vector<ProxyClientReport> client_reports() const;

 private:
  struct Client {
    io::Fd upstream;
    io::SocketAddress address;
    io::LocalAddress local;
    io::PeerKey key;
    Duration last_seen{};
    std::uint32_t kernel_drops = 0;
  };

  Proxy(const ProxyOptions& options, io::Fd socket, io::Fd poll, io::Fd wake, const io::SocketAddress& listening);

  [[nodiscard]] Duration wait_limit(Duration now) const noexcept;
  void receive_from_clients() noexcept;
  void receive_from_server(std::uint32_t client) noexcept;
  void send_due() noexcept;
  void flush(int fd, std::span<const ProxyCore::Egress> sent) noexcept;
  [[nodiscard]] std::optional<std::uint32_t> client_of(std::size_t message, const io::LocalAddress& local) noexcept;
  [[nodiscard]] std::optional<std::uint32_t> welcome(const io::PeerKey& key, std::size_t message,
                                                     const io::LocalAddress& local) noexcept;
  void forget_idle() noexcept;
  void forget(std::uint32_t client) noexcept;
  void count_kernel_drops(std::uint32_t& seen, std::uint32_t now) noexcept;
  [[nodiscard]] ProxyStatus snapshot() const;
  void publish() noexcept;

  ProxyOptions options_;
  io::Fd socket_, poll_, wake_;
  io::SocketAddress listening_;
  bool any_address_;
  ProxyCore core_;
  std::array<io::PeerKey, ProxyCore::kClientsMax> keys_{};
  std::array<bool, ProxyCore::kClientsMax> present_{};
  std::array<Client, ProxyCore::kClientsMax> clients_;
  std::uint32_t last_client_ = 0;
  std::uint32_t kernel_drops_seen_ = 0;
  io::ReceiveBatch in_;
  io::SendBatch out_;
  Histogram lateness_;
  ProxyTroubles troubles_;
  Duration started_{};  ///< CLOCK_MONOTONIC
  Duration now_{};      ///< since start, read once per round
  std::vector<ProxyClientReport> left_;
  mutable std::mutex published_lock_;
  ProxyStatus published_;
};

}  // namespace tandem::netsim
