// Real connections through the relay on this computer.
#include "netsim/proxy/app/tcp_relay.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <asio.hpp>
#include <atomic>
#include <cerrno>
#include <string>
#include <thread>
#include <vector>

namespace {
std::atomic<int> without_descriptor{0};  ///< attempts to accept that failed because no file descriptor was free
}

/// In place of the C library's, so that the attempts of the relay are counted.
extern "C" int accept(int fd, sockaddr* from, socklen_t* size) {
  const auto made = static_cast<int>(::syscall(SYS_accept, fd, from, size));
  if (made < 0 && errno == EMFILE) ++without_descriptor;
  return made;
}

namespace tandem::netsim {
namespace {

using asio::ip::tcp;

io::TcpListener listener() { return std::move(*io::listen_tcp(*io::parse_address("127.0.0.1:0", 0))); }
tcp::endpoint at(const io::SocketAddress& a) { return {asio::ip::address_v4::loopback(), a.port()}; }

std::string read_all(tcp::socket& s) {
  std::string out;
  std::error_code error;
  asio::read(s, asio::dynamic_buffer(out), error);
  EXPECT_EQ(error, asio::error::eof);
  return out;
}

TEST(TcpRelay, ForwardsBytesAndEndOfStreamBothWays) {
  asio::io_context context;
  tcp::acceptor server{context, {asio::ip::address_v4::loopback(), 0}};
  io::TcpListener listening = listener();
  const tcp::endpoint relay_at = at(listening.local);
  const TcpRelay relay{std::move(listening),
                       *io::parse_address("127.0.0.1:" + std::to_string(server.local_endpoint().port()), 1)};

  const std::string up(1'000'000, 'u'), down(700'000, 'd');
  std::thread peer([&] {
    tcp::socket s = server.accept();
    EXPECT_EQ(read_all(s), up);  // end of stream arrives while the other direction is still open
    asio::write(s, asio::buffer(down));
  });
  tcp::socket client{context};
  client.connect(relay_at);
  asio::write(client, asio::buffer(up));
  client.shutdown(tcp::socket::shutdown_send);
  EXPECT_EQ(read_all(client), down);
  peer.join();
}

TEST(TcpRelay, ClosesIfTheTargetDoesNotListen) {
  asio::io_context context;
  io::SocketAddress nobody;
  {
    const io::TcpListener gone = listener();
    nobody = gone.local;
  }
  io::TcpListener listening = listener();
  const tcp::endpoint relay_at = at(listening.local);
  const TcpRelay relay{std::move(listening), nobody};
  tcp::socket client{context};
  client.connect(relay_at);
  EXPECT_EQ(read_all(client), "");
}

/// @return whether the socket becomes readable, or its peer closes it
bool readable(auto& socket, std::chrono::milliseconds within) {
  pollfd at{socket.native_handle(), POLLIN, 0};
  return ::poll(&at, 1, static_cast<int>(within.count())) == 1;
}

TEST(TcpRelay, LetsFurtherConnectionsWaitUntilOneEnds) {
  asio::io_context context;
  tcp::acceptor server{context, {asio::ip::address_v4::loopback(), 0}};
  io::TcpListener listening = listener();
  const tcp::endpoint relay_at = at(listening.local);
  const TcpRelay relay{std::move(listening),
                       *io::parse_address("127.0.0.1:" + std::to_string(server.local_endpoint().port()), 1), 2};
  std::vector<tcp::socket> clients, peers;
  for (int i = 0; i < 3; ++i) {
    clients.emplace_back(context).connect(relay_at);
    if (i < 2) peers.push_back(server.accept());
  }
  EXPECT_FALSE(readable(clients.back(), std::chrono::milliseconds(300))) << "the relay has closed the third one";
  clients.front().close();
  peers.front().close();
  EXPECT_TRUE(readable(server, std::chrono::seconds(10)));
}

TEST(TcpRelay, WaitsForAFileDescriptorWithoutLoadingAProcessor) {
  asio::io_context context;
  tcp::acceptor server{context, {asio::ip::address_v4::loopback(), 0}};
  io::TcpListener listening = listener();
  const tcp::endpoint relay_at = at(listening.local);
  const TcpRelay relay{std::move(listening),
                       *io::parse_address("127.0.0.1:" + std::to_string(server.local_endpoint().port()), 1)};
  tcp::socket client{context, tcp::v4()};
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{3, before.rlim_max};  // those in use stay open
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  client.connect(relay_at);
  const bool came = readable(server, std::chrono::milliseconds(500));
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_FALSE(came);
  EXPECT_GE(without_descriptor.load(), 1);
  EXPECT_LE(without_descriptor.load(), 20);
  EXPECT_TRUE(readable(server, std::chrono::seconds(10)));
}

TEST(TcpRelay, EndsWithConnectionsStillOpen) {
  asio::io_context context;
  tcp::acceptor server{context, {asio::ip::address_v4::loopback(), 0}};
  std::vector<tcp::socket> open;
  {
    io::TcpListener listening = listener();
    const tcp::endpoint relay_at = at(listening.local);
    const TcpRelay relay{std::move(listening),
                         *io::parse_address("127.0.0.1:" + std::to_string(server.local_endpoint().port()), 1)};
    for (int i = 0; i < 20; ++i) {
      open.emplace_back(context).connect(relay_at);
      open.push_back(server.accept());
    }
  }
  for (tcp::socket& s : open) EXPECT_EQ(read_all(s), "");
}

}  // namespace
}  // namespace tandem::netsim
