// A seat of a real session and a real client core, with an attacker on the path between them (ARCHITECTURE.md,
// invariants 10 and 11).
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "client/seat/seat.h"
#include "hal/sim/sim_device.h"
#include "netsim/system/simulated_handshake.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/session/session.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::byte>;

PeerAddress address(std::uint8_t n) {
  PeerAddress e;
  e.bytes[0] = std::byte{n};
  e.size = 1;
  return e;
}

/// One client at address 1 and one session, without network delay.
struct Rig {
  Rig() {
    AxisArray scale;
    scale.fill(1);
    std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
    slaves.push_back(std::move(*hal::sim::SimDevice::make({scene.tools[0].slave, {}, {}, nullptr, Time{}})));
    session = std::make_unique<Session>(scene, std::move(slaves), scale);
    device = std::move(*hal::sim::SimDevice::make({scene.seats[0].device, scene.seats[0].hand, {}, nullptr, now}));
    const auto joined = netsim::simulate_join(*session, now, 0, device->caps(), RandomKey{3}, 1);
    seat = std::make_unique<client::Seat>(joined->setup, device->caps(), joined->channel_params);
  }

  /// Runs one tick of the client. @return the datagrams it sends
  std::vector<Bytes> client_tick() {
    static_cast<void>(seat->on_servo(now, device->state()));
    std::vector<Bytes> out;
    std::array<std::byte, transport::kDatagramMax> buffer;
    while (const auto size = seat->poll_transmit(now, buffer))
      out.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*size));
    return out;
  }
  /// Runs one tick of the server. Its datagrams are counted; those for `client_at` are delivered.
  void server_tick() {
    session->on_tick(now, 0);
    std::array<std::byte, transport::kDatagramMax> buffer;
    while (const auto out = session->poll_transmit(now, buffer)) {
      const auto to = std::to_integer<std::uint8_t>(out->to.bytes[0]);
      const auto bytes = std::span{buffer}.first(out->size);
      const auto type = transport::read_header(bytes)->type;
      ++(type == wire::Type::kForce ? forces : challenges)[to];
      if (to == client_at) seat->on_datagram(now, bytes);
    }
  }
  void run(Duration length) {
    for (const Time end = now + length; now < end; now += 1ms) {
      for (const Bytes& d : client_tick()) session->on_datagram(now, address(client_at), d);
      server_tick();
    }
  }

  SceneSpec scene = *parse_scene(find_shipped_scene("one_axis")->text, "one_axis.textproto");
  Time now{1h};
  std::unique_ptr<Session> session;
  std::unique_ptr<hal::sim::SimDevice> device;
  std::unique_ptr<client::Seat> seat;
  std::uint8_t client_at = 1;
  std::map<std::uint8_t, int> forces, challenges;
};

TEST(Connection, SendsForcesOnlyToTheValidatedAddress) {
  Rig rig;
  rig.run(100ms);
  EXPECT_EQ(rig.challenges[1], 1);
  EXPECT_GE(rig.forces[1], 97);
}

TEST(Connection, FollowsAClientToItsNewAddress) {
  Rig rig;
  rig.run(100ms);
  rig.client_at = 2;  // its NAT assigned another port
  const int before = rig.forces[1];
  rig.run(100ms);
  EXPECT_LE(rig.forces[1] - before, 2) << "until the new address had answered";
  EXPECT_EQ(rig.challenges[2], 1);
  EXPECT_GE(rig.forces[2], 97);
}

// "Copied valid packet raced from another address, 1000 times: at most one path challenge each, force stream not
// moved."
TEST(Connection, DoesNotMigrateToASenderOfCopiedDatagrams) {
  Rig rig;
  rig.run(100ms);
  const int before = rig.forces[1];
  for (int i = 0; i < 1000; ++i, rig.now += 1ms) {
    for (const Bytes& d : rig.client_tick()) {
      rig.session->on_datagram(rig.now, address(9), d);
      rig.session->on_datagram(rig.now, address(1), d);
    }
    rig.server_tick();
  }
  EXPECT_EQ(rig.forces[1] - before, 1000);
  EXPECT_EQ(rig.forces[9], 0);
  EXPECT_LE(rig.challenges[9], 20) << "one in 50 ms";
}

// "Spoofed source with valid cid, bad tag, 10 000 packets: no address move, no reply, AEAD failures counted."
TEST(Connection, DoesNotMigrateToASenderOfForgedDatagrams) {
  Rig rig;
  rig.run(100ms);
  const std::uint32_t cid = rig.session->seat(0).link()->own_cid();
  RandomStream random{4};
  for (int i = 0; i < 10'000; ++i) {
    Bytes d(321);
    for (std::byte& b : d) b = static_cast<std::byte>(random.bits());
    transport::write_header({wire::Type::kState, 0, cid, 1'000'000 + random.bits() % 1000},
                            std::span(d).first<transport::kHeaderSize>());
    rig.session->on_datagram(rig.now, address(9), d);
  }
  rig.run(300ms);
  EXPECT_EQ(rig.session->seat(0).link()->stats().dropped[static_cast<std::size_t>(transport::DropReason::kTag)],
            10'000U);
  EXPECT_EQ(rig.challenges[9] + rig.forces[9], 0);
  EXPECT_GE(rig.forces[1], 390);
}

}  // namespace
}  // namespace tandem::server
