// The stream for PlotJuggler: at most 100 datagrams per second, time stamps, lost receivers.
#include "client/app/plot_stream.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cerrno>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

io::UdpSocket receiver() { return io::bind_udp(io::parse_address("127.0.0.1:0", 0).value()).value(); }

PlotStream stream_to(const io::SocketAddress& to) { return PlotStream::open(to, Time{} + 5s, 1000s).value(); }

TEST(PlotStream, SendsAtMostOnceIn10Milliseconds) {
  const io::UdpSocket plot = receiver();
  PlotStream stream = stream_to(plot.local);
  int sent = 0;
  for (Time now = Time{} + 5s; now < Time{} + 6s; now += 1ms) {
    if (!stream.due(now)) continue;
    stream.send(now, "{}");
    ++sent;
  }
  EXPECT_EQ(sent, 100);
  EXPECT_EQ(stream.sent(), 100u);
  int received = 0;
  char buffer[8];
  while (recv(plot.fd.get(), buffer, sizeof buffer, MSG_DONTWAIT) == 2) ++received;
  EXPECT_EQ(received, 100);
}

TEST(PlotStream, CountsTimeFromTheWallClockAtItsStart) {
  const io::UdpSocket plot = receiver();
  const PlotStream stream = stream_to(plot.local);
  EXPECT_DOUBLE_EQ(stream.timestamp(Time{} + 5s), 1000);
  EXPECT_DOUBLE_EQ(stream.timestamp(Time{} + 7500ms), 1002.5);
}

TEST(PlotStream, DropsAndCountsWithoutAReceiver) {
  io::SocketAddress closed_port;
  {
    const io::UdpSocket plot = receiver();
    closed_port = plot.local;
  }
  PlotStream stream = stream_to(closed_port);
  Time now = Time{} + 5s;
  for (int k = 0; k < 20; ++k, now += 10ms) stream.send(now, "{}");
  EXPECT_EQ(stream.sent() + stream.dropped(), 20u);
  EXPECT_GT(stream.dropped(), 0u) << "loopback reports that no program listens";
  stream.send(now, std::string(100'000, 'x'));
  EXPECT_GT(stream.dropped(), 1u) << "longer than a datagram";
}

TEST(PlotStream, TellsWhetherThePlotProgramIsOnThisComputer) {
  EXPECT_TRUE(stream_to(io::parse_address(PlotStream::kDefaultAddress, 1).value()).on_this_computer());
  EXPECT_FALSE(stream_to(io::parse_address("192.0.2.1:9870", 1).value()).on_this_computer());
}

}  // namespace
}  // namespace tandem::client
