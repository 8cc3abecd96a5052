// The acceptor of control connections: addresses, errors, its rate, and its end.
#include "server/app/control/control_acceptor.h"

#include <gtest/gtest.h>

#include <asio/connect.hpp>
#include <vector>

#include "server/app/control/tcp_listener.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using asio::ip::tcp;

/// An acceptor whose clock stands still.
struct Accepting {
  [[nodiscard]] io::SocketAddress listen(const char* at) {
    const auto bound = acceptor.listen(*io::parse_address(at, 0));
    EXPECT_TRUE(bound) << bound.error();
    return bound.value_or(io::SocketAddress{});
  }
  /// Connects to a port of this computer and closes the connection. @return the error
  asio::error_code connect(const char* host, std::uint16_t port) {
    tcp::socket socket(context);
    asio::error_code error;
    socket.connect({asio::ip::make_address(host), port}, error);
    return error;
  }
  /// Runs the acceptor until it has accepted so many connections, for 30 s at most.
  void wait_for(int count) {
    while (accepted < count)
      if (context.run_one_for(30s) == 0) FAIL() << "only " << accepted << " accepted";
  }

  asio::io_context context;
  Time now{1h};
  int accepted = 0, failed = 0;
  ControlAcceptor acceptor{
      context, [this] { return now; }, {[this](const tcp::socket&) { ++accepted; }, [this](auto) { ++failed; }}};
};

TEST(ControlAcceptor, AcceptsOnAllItsAddresses) {
  Accepting a;
  const std::uint16_t first = a.listen("127.0.0.1:0").port(), second = a.listen("127.0.0.1:0").port();
  EXPECT_NE(first, second);
  for (const std::uint16_t port : {first, second, first}) EXPECT_FALSE(a.connect("127.0.0.1", port));
  a.wait_for(3);
  EXPECT_EQ(a.failed, 0);
}

TEST(ControlAcceptor, NamesAnAddressThatIsInUse) {
  Accepting a;
  const std::string used = io::to_text(a.listen("127.0.0.1:0"));
  const auto again = a.acceptor.listen(*io::parse_address(used, 0));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), "cannot listen on " + used + ": Address already in use");
}

TEST(ControlAcceptor, PausesWhenItsBurstIsUsedUp) {
  Accepting a;
  const std::uint16_t port = a.listen("127.0.0.1:0").port();
  for (int i = 0; i < 1001; ++i) ASSERT_FALSE(a.connect("127.0.0.1", port)) << i;
  a.wait_for(1000);
  a.context.poll();
  EXPECT_EQ(a.accepted, 1000) << "the clock stands still";
  a.now += 1s;
  a.wait_for(1001);
}

TEST(ControlAcceptor, ClosesItsListenersWhenItStops) {
  Accepting a;
  const std::uint16_t port = a.listen("127.0.0.1:0").port();
  a.acceptor.stop();
  EXPECT_EQ(a.connect("127.0.0.1", port), asio::error::connection_refused);
  a.context.run();  // returns, because nothing is left to do
  EXPECT_EQ(a.accepted, 0);
  EXPECT_EQ(a.failed, 0) << "stopping is no failure";
}

TEST(TcpListener, ReturnsTheChosenPortOfAnAddress) {
  asio::io_context context;
  tcp::acceptor acceptor(context);
  const auto bound = start_listening(acceptor, *io::parse_address("127.0.0.1:0", 0), 4, true);
  ASSERT_TRUE(bound) << bound.error();
  EXPECT_EQ(bound->port(), acceptor.local_endpoint().port());
  EXPECT_NE(bound->port(), 0);
  EXPECT_EQ(io::to_text(socket_address_of({asio::ip::make_address("192.0.2.7"), 7000})), "192.0.2.7:7000");
  EXPECT_EQ(io::to_text(socket_address_of({asio::ip::make_address("2001:db8::1"), 7000})), "[2001:db8::1]:7000");
}

}  // namespace
}  // namespace tandem::server
