#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <list>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/io/fd.h"
#include "common/io/socket_address.h"
#include "tests/io/free_address.h"

namespace tandem::test {

/// A path to a server that a test cuts and heals: it forwards TCP and UDP from an address of its own. While it is cut,
/// it forwards nothing and closes nothing, as a broken cable; UDP datagrams of that time are lost.
class CutPath {
 public:
  /// @param to  HOST:PORT of the server, for TCP and for UDP
  explicit CutPath(const std::string& to) : to_(*io::parse_address(to, 1)), address_(free_address()) {
    const auto own = io::parse_address(address_, 1);
    tcp_ = opened(SOCK_STREAM);
    udp_ = opened(SOCK_DGRAM);
    const int yes = 1;
    ::setsockopt(tcp_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    EXPECT_EQ(::bind(tcp_.get(), own->get(), own->size), 0) << address_;
    EXPECT_EQ(::bind(udp_.get(), own->get(), own->size), 0) << address_;
    EXPECT_EQ(::listen(tcp_.get(), 64), 0);
    thread_ = std::thread([this] {
      while (!stopping_) step();
    });
  }
  ~CutPath() {
    stopping_ = true;
    thread_.join();
  }
  CutPath(const CutPath&) = delete;
  CutPath& operator=(const CutPath&) = delete;

  [[nodiscard]] const std::string& address() const { return address_; }
  void cut() { cut_ = true; }
  /// TCP only passes, as through a firewall that blocks UDP.
  void cut_datagrams() { datagrams_cut_ = true; }
  void heal() { cut_ = datagrams_cut_ = false; }

 private:
  struct Pipe {
    io::Fd client, server;
    bool over = false;
  };
  struct Peer {
    io::SocketAddress from;
    io::Fd server;
  };

  static io::Fd opened(int kind) { return io::Fd{::socket(AF_INET, kind | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)}; }

  /// Waits for at most 5 ms, then forwards what has arrived.
  void step() {
    const bool cut = cut_;
    std::vector<pollfd> files{{udp_.get(), POLLIN, 0}};
    if (!cut) files.push_back({tcp_.get(), POLLIN, 0});
    for (const Peer& peer : peers_) files.push_back({peer.server.get(), POLLIN, 0});
    if (!cut)
      for (const Pipe& pipe : pipes_) {
        files.push_back({pipe.client.get(), POLLIN, 0});
        files.push_back({pipe.server.get(), POLLIN, 0});
      }
    ::poll(files.data(), files.size(), 5);
    forward_datagrams(cut || datagrams_cut_);
    if (cut) return;
    accept();
    for (Pipe& pipe : pipes_) {
      copy(pipe, pipe.client, pipe.server);
      copy(pipe, pipe.server, pipe.client);
    }
    std::erase_if(pipes_, [](const Pipe& pipe) { return pipe.over; });
  }
  void accept() {
    io::Fd client{::accept4(tcp_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK)};
    if (!client.open()) return;
    io::Fd server{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    if (::connect(server.get(), to_.get(), to_.size) == 0) pipes_.push_back({std::move(client), std::move(server)});
  }
  /// Copies what has arrived. Loopback takes it whole; if it does not, the pipe ends.
  static void copy(Pipe& pipe, const io::Fd& from, const io::Fd& to) {
    std::array<char, 65536> part;
    const ssize_t size = ::recv(from.get(), part.data(), part.size(), MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0 || ::send(to.get(), part.data(), static_cast<std::size_t>(size), MSG_NOSIGNAL) != size)
      pipe.over = true;
  }
  void forward_datagrams(bool cut) {
    std::array<char, 2048> part;
    io::SocketAddress from;
    for (ssize_t size; from.size = sizeof from.storage,
                       (size = ::recvfrom(udp_.get(), part.data(), part.size(), 0,
                                          reinterpret_cast<sockaddr*>(&from.storage), &from.size)) >= 0;) {
      if (cut) continue;
      Peer& peer = peer_of(from);
      static_cast<void>(::send(peer.server.get(), part.data(), static_cast<std::size_t>(size), 0));
    }
    for (const Peer& peer : peers_)
      for (ssize_t size; (size = ::recv(peer.server.get(), part.data(), part.size(), 0)) >= 0;)
        if (!cut)
          static_cast<void>(
              ::sendto(udp_.get(), part.data(), static_cast<std::size_t>(size), 0, peer.from.get(), peer.from.size));
  }
  Peer& peer_of(const io::SocketAddress& from) {
    for (Peer& peer : peers_)
      if (io::to_text(peer.from) == io::to_text(from)) return peer;
    Peer& peer = peers_.emplace_back(Peer{from, opened(SOCK_DGRAM)});
    static_cast<void>(::connect(peer.server.get(), to_.get(), to_.size));
    return peer;
  }

  io::SocketAddress to_;
  std::string address_;
  io::Fd tcp_, udp_;
  std::list<Pipe> pipes_;
  std::list<Peer> peers_;
  std::atomic<bool> cut_{false}, datagrams_cut_{false}, stopping_{false};
  std::thread thread_;
};

}  // namespace tandem::test
