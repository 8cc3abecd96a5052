#pragma once

#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "common/io/datagram_batch.h"
#include "common/io/udp_socket.h"
#include "tests/bench/udp_load.h"

namespace tandem::bench {

/// Sockets of clients whose ticks are spread over the millisecond, as the ticks of separate workstations are. One
/// thread drives them.
class PhasedCrowd {
 public:
  /// @throws std::runtime_error
  PhasedCrowd(std::size_t clients, const io::SocketAddress& to)
      : poll_(epoll_create1(EPOLL_CLOEXEC)), unread_(clients) {
    for (std::size_t c = 0; c < clients; ++c) {
      auto socket = io::connect_udp(to);
      if (!socket) throw std::runtime_error(socket.error());
      io::ReceiveBatch::prepare(socket->fd.get(), AF_INET, false, kBufferBytes);
      epoll_event event{.events = EPOLLIN, .data = {.u64 = c}};
      epoll_ctl(poll_.get(), EPOLL_CTL_ADD, socket->fd.get(), &event);
      sockets_.push_back(std::move(socket->fd));
      // A step of the golden ratio spreads neighbours, so that the clients of one session have different phases.
      const double phase = 0.6180339887498949 * static_cast<double>(c);
      due_.push_back({io::monotonic_now() + kPeriod + from_seconds((phase - std::floor(phase)) * seconds(kPeriod)), c});
    }
    std::ranges::make_heap(due_, std::greater{});
  }

  /// Lets each client tick once per millisecond for `length`.
  /// @param send   `send(client, now, buffer)` returns the size of the next datagram [bytes]; 0: it sends none more now
  /// @param hear   `hear(client, arrived, bytes)`, with the kernel's time of arrival
  /// @param shift  `shift(client)`: by how much the client's next tick is later
  template <class Send, class Hear, class Shift>
  void run(Duration length, const Send& send, const Hear& hear, const Shift& shift) {
    std::array<std::byte, 1500> buffer;
    const Time end = io::monotonic_now() + length;
    for (Time now{}; now < end;) {
      std::ranges::pop_heap(due_, std::greater{});
      auto& [due, client] = due_.back();
      if (++unread_[client] > kUnreadMax) read(client, hear);
      now = io::monotonic_now();
      if (due - now > kIdle) receive(due, hear);
      while ((now = io::monotonic_now()) < due) {
      }
      late_.push_back((now - due).count());
      for (std::size_t size; (size = send(client, now, buffer)) > 0;) [[maybe_unused]]
        const auto sent = ::send(sockets_[client].get(), buffer.data(), size, 0);
      due += kPeriod + shift(client);
      std::ranges::push_heap(due_, std::greater{});
    }
  }
  /// Time by which this thread was late to send [ns], since the last call.
  [[nodiscard]] std::vector<std::int64_t> take_lateness() { return std::exchange(late_, {}); }

 private:
  static constexpr Duration kPeriod = std::chrono::milliseconds(1);
  static constexpr int kBufferBytes = 1 << 18;
  // The kernel notes the times of arrival, so that reading may wait until there is nothing to send.
  static constexpr Duration kIdle = std::chrono::microseconds(20);
  static constexpr int kUnreadMax = 4;  ///< [ticks]

  /// Receives until shortly before `until`.
  template <class Hear>
  void receive(Time until, const Hear& hear) {
    std::array<epoll_event, 16> ready;
    do {
      const timespec rest = io::to_timespec(std::max(Duration{}, until - kIdle - io::monotonic_now()));
      const int count = epoll_pwait2(poll_.get(), ready.data(), static_cast<int>(ready.size()), &rest, nullptr);
      for (int k = 0; k < count; ++k) read(ready[static_cast<std::size_t>(k)].data.u64, hear);
    } while (io::monotonic_now() + kIdle < until);
  }
  template <class Hear>
  void read(std::size_t client, const Hear& hear) {
    unread_[client] = 0;
    const int datagrams = in_.receive(sockets_[client].get());
    const Duration wall = io::read_clock(CLOCK_REALTIME);
    const Time now = io::monotonic_now();
    for (int i = 0; i < datagrams; ++i) {
      const auto at = static_cast<std::size_t>(i);
      hear(client, now - in_.details(at, wall).age, in_.bytes(at));
    }
  }

  io::Fd poll_;
  std::vector<io::Fd> sockets_;
  std::vector<std::pair<Time, std::size_t>> due_;  ///< next tick of each client, the earliest at the front
  std::vector<std::int64_t> late_;
  std::vector<int> unread_;  ///< ticks of each client since the last look for its answers
  io::ReceiveBatch in_;
};

}  // namespace tandem::bench
