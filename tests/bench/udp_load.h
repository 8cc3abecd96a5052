#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <ctime>
#include <vector>

#include "common/io/clock.h"
#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::bench {

/// Load on a UDP forwarder: one thread drives the clients and the server at its two sides. Each millisecond every
/// client sends `kBytes` to the server, and the server sends `kBytes` to every client.
class UdpLoad {
 public:
  static constexpr std::size_t kBytes = 128;

  struct Counts {
    std::uint64_t sent = 0, up = 0, down = 0;  ///< sent counts both directions
  };

  explicit UdpLoad(std::size_t clients) : clients_(clients), server_(udp()) {
    address_ = bind_loopback(server_.get());
    for (std::size_t i = 0; i < clients; ++i) sockets_.push_back(udp());
  }
  [[nodiscard]] const io::SocketAddress& server() const { return address_; }

  /// Each client sends datagrams until the server has received one from each. @return whether it did, within 20 s
  bool meet(const io::SocketAddress& forwarder) {
    upstreams_.assign(clients_, {});
    for (auto& socket : sockets_) ::connect(socket.get(), forwarder.get(), forwarder.size);
    std::size_t met = 0;
    for (int attempt = 0; attempt < 2000 && met < clients_; ++attempt) {
      for (std::uint32_t i = 0; i < clients_; ++i) {
        if (upstreams_[i].size == 0) met_.sent += ::send(sockets_[i].get(), &i, sizeof i, 0) >= 0 ? 1 : 0;
      }
      pause_until(io::read_clock(CLOCK_MONOTONIC) + Duration{10'000'000});
      std::uint32_t who = 0;
      io::SocketAddress from;
      from.size = sizeof from.storage;
      while (::recvfrom(server_.get(), &who, sizeof who, MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&from.storage),
                        &from.size) == sizeof who) {
        ++met_.up;
        if (who < clients_ && upstreams_[who].size == 0) ++met, upstreams_[who] = from;
        from.size = sizeof from.storage;
      }
    }
    return met == clients_;
  }

  /// Returns the datagrams that `meet` sent and received.
  [[nodiscard]] const Counts& met() const { return met_; }

  /// Sends for `length`. @param spread  true: clients one after another within the millisecond; false: all at its
  /// beginning
  Counts run(Duration length, bool spread) {
    Counts counts;
    const Duration begin = io::read_clock(CLOCK_MONOTONIC);
    const std::int64_t steps = length / Duration{1'000'000};
    const auto per_ms = static_cast<std::int64_t>(clients_);
    const Duration step = Duration{1'000'000} / per_ms;
    for (std::int64_t ms = 0; ms < steps; ++ms) {
      for (std::int64_t i = 0; i < per_ms; ++i) {
        if (spread || i == 0) pause_until(begin + Duration{1'000'000} * ms + step * i);
        const auto client = static_cast<std::size_t>(i);
        counts.sent += ::send(sockets_[client].get(), bytes_.data(), kBytes, 0) >= 0 ? 1 : 0;
        const io::SocketAddress& to = upstreams_[client];
        counts.sent += ::sendto(server_.get(), bytes_.data(), kBytes, 0, to.get(), to.size) >= 0 ? 1 : 0;
      }
      if (ms % 4 == 3) drain(counts);
    }
    return counts;
  }
  /// Reads and counts all datagrams that arrived.
  void drain(Counts& counts) {
    while (::recv(server_.get(), in_.data(), in_.size(), MSG_DONTWAIT) >= 0) ++counts.up;
    for (const io::Fd& socket : sockets_) {
      while (::recv(socket.get(), in_.data(), in_.size(), MSG_DONTWAIT) >= 0) ++counts.down;
    }
  }
  static void pause_until(Duration moment) {
    const timespec at = io::to_timespec(moment);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
  }

 private:
  static io::Fd udp() {
    io::Fd fd{::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
    const int buffer = 4 << 20;
    if (setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof buffer) != 0) {
      setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
    }
    return fd;
  }
  static io::SocketAddress bind_loopback(int fd) {
    const auto any = io::parse_address("127.0.0.1:0", 0);
    ::bind(fd, any->get(), any->size);
    io::SocketAddress local;
    local.size = sizeof local.storage;
    ::getsockname(fd, reinterpret_cast<sockaddr*>(&local.storage), &local.size);
    return local;
  }

  std::size_t clients_;
  Counts met_;
  io::Fd server_;
  io::SocketAddress address_;
  std::vector<io::Fd> sockets_;
  std::vector<io::SocketAddress> upstreams_;  ///< the forwarder's address for each client, as the server sees it
  std::array<std::byte, kBytes> bytes_{};
  std::array<std::byte, 2048> in_{};
};

}  // namespace tandem::bench
