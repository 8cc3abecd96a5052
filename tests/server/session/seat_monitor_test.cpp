// Audit events of one seat whose client sends STATE, falls silent and comes back.
#include "server/session/seat_monitor.h"

#include <gtest/gtest.h>

#include "server/session/seat_catalogue.h"
#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using What = AuditEvent::What;
using Whats = std::vector<What>;

/// free_motion: seat 0 is an instructor's, seat 1 a trainee's.
struct MonitoredSeat : test::SessionParts {
  explicit MonitoredSeat(std::size_t seat) : SessionParts("free_motion"), number(seat) {
    AxisArray scale;
    scale.fill(1);
    transport::SecureChannel::Params keys;
    keys.outgoing = transport::Direction::kToClient;
    keys.own_cid = 1;
    keys.peer_cid = 2;
    keys.tick = clock.tick_length();
    SeatConnection connection = SeatCatalogue(scene, scale).make_connection(seat, keys, {});
    seats[seat].attach(now, connection);
    std::swap(keys.own_cid, keys.peer_cid);
    keys.outgoing = transport::Direction::kToServer;
    client.emplace(keys);
  }
  /// The client receives a FORCE and sends `state`, which takes effect.
  void send() {
    std::array<std::byte, transport::kDatagramMax> bytes{};
    transport::SecureChannel& server = *seats[number].link();
    const auto payload = std::span{bytes}.subspan(transport::kHeaderSize);
    const std::size_t force = codec.encode(server.preamble(now, 0), wire::ForceMessage{}, payload);
    // The STATE echoes this FORCE, which shows that the client receives.
    const auto opened = client->open(now, std::span{bytes}.first(server.seal(now, wire::Type::kForce, bytes, force)));
    ASSERT_TRUE(opened);
    client->accept(now, *opened, codec.decode_force(opened->plaintext)->preamble);
    const std::size_t plain = codec.encode(client->preamble(now, 0), state, payload);
    const std::size_t size = client->seal(now, wire::Type::kState, bytes, plain);
    const auto datagram = std::span<const std::byte>{bytes}.first(size);
    EXPECT_TRUE(seats[number].on_datagram(now, {}, *transport::read_header(datagram), datagram, tokens).accepted_state);
  }
  Whats step(Duration after = {}) {
    now += after;
    monitor.step(now, number, seats[number], seats[number].condition(now), audit);
    Whats out;
    for (const AuditEvent& e : events()) {
      EXPECT_EQ(e.seat, number);
      out.push_back(e.what);
    }
    return out;
  }

  std::size_t number;
  Time now{1h};
  PathTokens tokens;
  wire::Codec codec{body_layout(seat_setup(scene, number))};
  wire::StateMessage state;
  std::optional<transport::SecureChannel> client;
  SeatMonitor monitor;
};

TEST(SeatMonitor, ReportsNothingBeforeTheFirstState) {
  MonitoredSeat seat(0);
  EXPECT_EQ(seat.step(1h), Whats{});
}

TEST(SeatMonitor, ReportsEachChangeOnce) {
  MonitoredSeat seat(0);
  seat.send();
  EXPECT_EQ(seat.step(), Whats{});
  seat.state.stop = true;
  seat.now += 1ms;
  seat.send();
  EXPECT_EQ(seat.step(), Whats{What::kLocalStop});
  EXPECT_EQ(seat.step(1ms), Whats{});
  seat.state.stop = false;
  seat.send();
  EXPECT_EQ(seat.step(), Whats{What::kLocalResume});
  seat.seats[0].misbehaviour().report_misbehaviour(seat.now);
  EXPECT_EQ(seat.step(), Whats{What::kQuarantined});
  EXPECT_EQ(seat.step(10ms), Whats{});
  seat.now += MisbehaviourMonitor::kQuarantineTime;
  seat.send();
  EXPECT_EQ(seat.step(), Whats{What::kCleared});
}

TEST(SeatMonitor, ReportsAnInstructorWhoIsAwayForTenSecondsOncePerLoss) {
  for (const std::size_t number : {0u, 1u}) {
    MonitoredSeat seat(number);
    const Whats away = number == 0 ? Whats{What::kInstructorAway} : Whats{};
    for (int losses = 0; losses < 2; ++losses) {
      seat.send();
      EXPECT_EQ(seat.step(), losses == 0 ? Whats{} : Whats{What::kBack});
      EXPECT_EQ(seat.step(1s), Whats{What::kLoss});
      EXPECT_EQ(seat.step(10s - 1ms), Whats{});
      EXPECT_EQ(seat.step(1ms), away);
      EXPECT_EQ(seat.step(10s), Whats{});
    }
  }
}

}  // namespace
}  // namespace tandem::server
