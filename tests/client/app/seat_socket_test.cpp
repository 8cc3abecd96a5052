// Datagrams between a seat and a socket on loopback.
#include "client/app/seat_socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <numeric>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/text/seat_setup.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Time kBegin{1s};

/// A seat of the shipped scene `devices` with its socket, and the socket of a server that does not reply.
struct SeatOnLoopback {
  SeatOnLoopback() : SeatOnLoopback(parse_scene(find_shipped_scene("devices")->text, "devices").value()) {}
  explicit SeatOnLoopback(const SceneSpec& scene)
      : setup(seat_setup(scene, 0)),
        server(io::bind_udp(*io::parse_address("127.0.0.1:0", 0)).value()),
        own(io::connect_udp(server.local).value()),
        to(own.local),
        seat(setup, three_axes(), {transport::Direction::kToServer, 1, 2}),
        socket(std::move(own)) {}

  static hal::DeviceCaps three_axes() {
    hal::DeviceCaps caps;
    caps.joints = caps.tip_axes = 3;
    return caps;
  }
  /// Sends a datagram to the seat's socket.
  void reply(std::span<const std::byte> bytes) const {
    ASSERT_EQ(::sendto(server.fd.get(), bytes.data(), bytes.size(), 0, to.get(), to.size),
              static_cast<ssize_t>(bytes.size()));
  }
  /// Returns the next datagram that the server received; empty if none waits.
  [[nodiscard]] std::vector<std::byte> received() const {
    std::vector<std::byte> bytes(transport::kDatagramMax);
    const ssize_t size = ::recv(server.fd.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }
  /// Number of datagrams that the seat rejected.
  [[nodiscard]] std::uint64_t dropped() const {
    const auto& reasons = seat.link().stats().dropped;
    return std::accumulate(reasons.begin(), reasons.end(), std::uint64_t{0});
  }

  SeatSetup setup;
  io::UdpSocket server, own;
  io::SocketAddress to;
  Seat seat;
  SeatSocket socket;
};

TEST(SeatSocket, SendsEachDatagramOfTheSeatOnce) {
  SeatOnLoopback at;
  transport::SecureChannel server{{transport::Direction::kToClient, 2, 1}};
  hal::State state;
  state.J.leftCols<3>().setIdentity();
  static_cast<void>(at.seat.on_servo(kBegin, state));
  at.socket.send(kBegin, at.seat);
  const auto datagram = at.received();
  const auto opened = server.open(kBegin, datagram);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->type, wire::Type::kState);
  at.socket.send(kBegin, at.seat);
  EXPECT_TRUE(at.received().empty()) << "the next STATE is due with the next tick";
}

TEST(SeatSocket, PassesAReceivedDatagramToTheSeat) {
  SeatOnLoopback at;
  const wire::Codec codec{body_layout(at.setup)};
  ClientChannel server{{transport::Direction::kToClient, 2, 1}, codec};
  std::array<std::byte, transport::kDatagramMax> buffer;
  const auto size = server.seal(kBegin, 0, wire::Type::kClose, wire::CloseMessage{wire::CloseReason::kDone}, buffer);
  ASSERT_TRUE(size);
  at.socket.receive(kBegin, at.seat);
  EXPECT_FALSE(at.seat.closed()) << "nothing waits";
  at.reply(std::span{buffer}.first(*size));
  at.socket.receive(kBegin, at.seat);
  EXPECT_TRUE(at.seat.closed());
}

TEST(SeatSocket, ReadsAtMostFourBatchesPerTickAndNoCutDatagram) {
  SeatOnLoopback at;
  for (int i = 0; i < 260; ++i) at.reply(std::array<std::byte, 3>{});
  at.socket.receive(kBegin, at.seat);
  EXPECT_EQ(at.dropped(), 256U) << "4 batches of 64";
  at.socket.receive(kBegin, at.seat);
  EXPECT_EQ(at.dropped(), 260U);
  at.reply(std::vector<std::byte>(io::ReceiveBatch::kSlotBytes + 1));
  at.socket.receive(kBegin, at.seat);
  EXPECT_EQ(at.dropped(), 260U) << "a longer datagram than a batch can hold does not reach the seat";
}

TEST(SeatSocket, ExchangesItsSocket) {
  SeatOnLoopback at;
  io::UdpSocket other = io::connect_udp(at.server.local).value();
  const int fd = other.fd.get();
  at.socket.swap(other);
  EXPECT_NE(other.fd.get(), fd);
  at.reply(std::array<std::byte, 3>{});  // to the old one
  at.socket.receive(kBegin, at.seat);
  EXPECT_EQ(at.dropped(), 0U);
  at.socket.swap(other);
  at.socket.receive(kBegin, at.seat);
  EXPECT_EQ(at.dropped(), 1U);
}

}  // namespace
}  // namespace tandem::client
