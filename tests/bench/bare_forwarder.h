#pragma once

#include <netinet/in.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::bench {

/// Minimal UDP forwarder with a socket pair per client: epoll, recvmmsg, and sendmmsg on the other socket of the pair.
/// It has no network model, no time stamps and no counters. Reference for the cost of the proxy.
class BareForwarder {
 public:
  BareForwarder(const io::SocketAddress& to) : to_(to), listen_(udp()), poll_(epoll_create1(0)), wake_(eventfd(0, 0)) {
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    share(listen_.get());
    ::bind(listen_.get(), reinterpret_cast<const sockaddr*>(&any), sizeof any);
    listening_.size = sizeof listening_.storage;
    ::getsockname(listen_.get(), reinterpret_cast<sockaddr*>(&listening_.storage), &listening_.size);
    watch(wake_.get(), kWake);
    watch(listen_.get(), kListen);
    for (std::size_t i = 0; i < kBatch; ++i) {
      pieces_[i] = {data_[i].data(), data_[i].size()};
      headers_[i].msg_hdr.msg_iov = &pieces_[i];
      headers_[i].msg_hdr.msg_iovlen = 1;
    }
  }

  [[nodiscard]] const io::SocketAddress& listening() const { return listening_; }
  void stop() {
    stopping_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
  }

  void run() {
    std::array<epoll_event, 192> events;
    while (!stopping_) {
      const int ready = epoll_wait(poll_.get(), events.data(), events.size(), -1);
      for (int i = 0; i < ready; ++i) {
        const std::uint64_t name = events[static_cast<std::size_t>(i)].data.u64;
        if (name == kWake) break;
        if (name == kListen) {
          welcome();
        } else {
          forward(sockets_[name].get(), sockets_[name ^ 1].get());
        }
      }
    }
  }

 private:
  static constexpr std::size_t kBatch = 64;
  static constexpr std::uint64_t kListen = 1000, kWake = 1001;

  static io::Fd udp() {
    io::Fd fd{::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)};
    const int buffer = 1 << 20;
    setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUFFORCE, &buffer, sizeof buffer);
    setsockopt(fd.get(), SOL_SOCKET, SO_SNDBUFFORCE, &buffer, sizeof buffer);
    return fd;
  }
  static void share(int fd) {
    const int on = 1;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  }
  void watch(int fd, std::uint64_t name) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = name;
    epoll_ctl(poll_.get(), EPOLL_CTL_ADD, fd, &event);
  }
  void welcome() {
    io::SocketAddress from;
    from.size = sizeof from.storage;
    const auto n = ::recvfrom(listen_.get(), data_[0].data(), data_[0].size(), 0,
                              reinterpret_cast<sockaddr*>(&from.storage), &from.size);
    if (n < 0) return;
    io::Fd down = udp(), up = udp();
    share(down.get());
    ::bind(down.get(), listening_.get(), listening_.size);
    ::connect(down.get(), from.get(), from.size);
    ::connect(up.get(), to_.get(), to_.size);
    ::send(up.get(), data_[0].data(), static_cast<std::size_t>(n), 0);
    watch(down.get(), sockets_.size());
    watch(up.get(), sockets_.size() + 1);
    sockets_.push_back(std::move(down));
    sockets_.push_back(std::move(up));
  }
  void forward(int from, int to) {
    const int count = recvmmsg(from, headers_.data(), kBatch, MSG_DONTWAIT, nullptr);
    if (count <= 0) return;
    for (int i = 0; i < count; ++i) pieces_[i].iov_len = headers_[i].msg_len;
    for (int sent = 0; sent < count;) {
      const int n = sendmmsg(to, headers_.data() + sent, static_cast<unsigned>(count - sent), 0);
      if (n <= 0) break;
      sent += n;
    }
    for (int i = 0; i < count; ++i) pieces_[i].iov_len = data_[0].size();
  }

  io::SocketAddress to_, listening_;
  io::Fd listen_, poll_, wake_;
  std::atomic<bool> stopping_{false};
  std::vector<io::Fd> sockets_;  ///< index 2 n: towards client n; 2 n + 1: towards the server
  std::array<std::array<std::byte, 1500>, kBatch> data_;
  std::array<iovec, kBatch> pieces_{};
  std::array<mmsghdr, kBatch> headers_{};
};

}  // namespace tandem::bench
