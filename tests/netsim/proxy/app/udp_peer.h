#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::netsim::test {

/// UDP endpoint of a test. Waits have a limit far above the need; tests never assert their length.
class UdpPeer {
 public:
  static constexpr int kPatienceMs = 20'000;

  /// Binds to `HOST:PORT`; port 0 selects a free one.
  explicit UdpPeer(const std::string& bind_to = "127.0.0.1:0") {
    const auto address = io::parse_address(bind_to, 0);
    fd_ = io::Fd{::socket(address->family(), SOCK_DGRAM | SOCK_CLOEXEC, 0)};
    bound_ = ::bind(fd_.get(), address->get(), address->size) == 0;
    address_.size = sizeof address_.storage;
    ::getsockname(fd_.get(), reinterpret_cast<sockaddr*>(&address_.storage), &address_.size);
  }

  [[nodiscard]] bool bound() const { return bound_; }
  [[nodiscard]] const io::SocketAddress& address() const { return address_; }

  void connect(const io::SocketAddress& to) { ::connect(fd_.get(), to.get(), to.size); }
  bool send(const std::string& bytes) { return ::send(fd_.get(), bytes.data(), bytes.size(), 0) >= 0; }
  bool send_to(const io::SocketAddress& to, const std::string& bytes) {
    return ::sendto(fd_.get(), bytes.data(), bytes.size(), 0, to.get(), to.size) >= 0;
  }

  struct Received {
    std::string bytes;
    io::SocketAddress from;
  };
  /// Returns the next datagram; empty if none arrives for `patience_ms`.
  std::optional<Received> receive(int patience_ms = kPatienceMs) {
    pollfd ready{fd_.get(), POLLIN, 0};
    while (::poll(&ready, 1, patience_ms) > 0) {
      Received received;
      received.bytes.resize(65'536);
      received.from.size = sizeof received.from.storage;
      const auto n = ::recvfrom(fd_.get(), received.bytes.data(), received.bytes.size(), 0,
                                reinterpret_cast<sockaddr*>(&received.from.storage), &received.from.size);
      if (n < 0) continue;  // refused: report about an earlier datagram
      received.bytes.resize(static_cast<std::size_t>(n));
      return received;
    }
    return std::nullopt;
  }

 private:
  io::Fd fd_;
  io::SocketAddress address_;
  bool bound_ = false;
};

}  // namespace tandem::netsim::test
