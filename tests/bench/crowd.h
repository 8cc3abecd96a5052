#pragma once

#include <pthread.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "common/io/udp_socket.h"
#include "tests/bench/udp_load.h"

namespace tandem::bench {

/// Returns the CPU time of a thread so far, in user space and in the kernel.
inline Duration cpu_of(pthread_t thread) {
  clockid_t clock{};
  pthread_getcpuclockid(thread, &clock);
  return io::read_clock(clock);
}

/// Sockets of many clients. One thread drives them: all clients send at the start of each period.
class Crowd {
 public:
  Crowd(std::size_t clients, const io::SocketAddress& to) {
    for (std::size_t i = 0; i < clients; ++i) sockets_.push_back(std::move(io::connect_udp(to)->fd));
  }
  template <class Fill, class Hear>
  void run(Duration length, Fill fill, Hear hear, Duration period = std::chrono::milliseconds(1)) {
    std::array<std::byte, 1500> buffer;
    const Time begin = io::monotonic_now();
    for (int n = 1; n <= length / period; ++n) {
      UdpLoad::pause_until((begin + n * period).time_since_epoch());
      for (std::size_t c = 0; c < sockets_.size(); ++c) {
        for (ssize_t size; (size = ::recv(sockets_[c].get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
          hear(c, std::span{buffer}.first(static_cast<std::size_t>(size)));
        for (std::size_t size; (size = fill(c, buffer)) > 0;) [[maybe_unused]]
          const auto sent = ::send(sockets_[c].get(), buffer.data(), size, 0);
      }
    }
  }

 private:
  std::vector<io::Fd> sockets_;
};

}  // namespace tandem::bench
