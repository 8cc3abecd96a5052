#pragma once

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "common/io/udp_socket.h"

namespace tandem::bench {

/// One connected UDP socket per client.
class UdpClients {
 public:
  /// @throws std::runtime_error
  UdpClients(std::size_t clients, std::uint16_t port) : poll_(epoll_create1(EPOLL_CLOEXEC)), ready_(clients) {
    const auto server = io::parse_address("127.0.0.1:" + std::to_string(port), 0);
    for (std::size_t c = 0; c < clients; ++c) {
      auto socket = io::connect_udp(*server);
      if (!socket) throw std::runtime_error(socket.error());
      sockets_.push_back(std::move(socket->fd));
      epoll_event event{.events = EPOLLIN, .data = {.u64 = c}};
      epoll_ctl(poll_.get(), EPOLL_CTL_ADD, sockets_.back().get(), &event);
    }
  }

  void send(std::size_t client, std::span<const std::byte> bytes) {
    [[maybe_unused]] const auto sent = ::send(sockets_[client].get(), bytes.data(), bytes.size(), 0);
  }
  /// Calls `each(client, bytes)` for every datagram until `until`.
  template <class Each>
  void receive(Time until, const Each& each) {
    for (Duration left; (left = until - io::monotonic_now()) > Duration{};) {
      const timespec timeout = io::to_timespec(left);
      const int ready = epoll_pwait2(poll_.get(), ready_.data(), static_cast<int>(ready_.size()), &timeout, nullptr);
      for (int i = 0; i < ready; ++i) {
        const auto client = static_cast<std::size_t>(ready_[static_cast<std::size_t>(i)].data.u64);
        for (ssize_t size; (size = ::recv(sockets_[client].get(), bytes_.data(), bytes_.size(), MSG_DONTWAIT)) > 0;)
          each(client, std::span{bytes_}.first(static_cast<std::size_t>(size)));
      }
    }
  }

 private:
  io::Fd poll_;
  std::vector<io::Fd> sockets_;
  std::vector<epoll_event> ready_;
  std::array<std::byte, 1500> bytes_;
};

}  // namespace tandem::bench
