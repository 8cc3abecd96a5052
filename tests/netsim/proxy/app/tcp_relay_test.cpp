// Real connections through the relay on this computer.
#include "netsim/proxy/app/tcp_relay.h"

#include <gtest/gtest.h>

#include <asio.hpp>
#include <string>
#include <thread>
#include <vector>

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
