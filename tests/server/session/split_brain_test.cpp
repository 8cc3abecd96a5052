// Split brain (ARCHITECTURE.md, invariant 50): the former server of a session does not know that there is a new one,
// and continues to send.
#include <gtest/gtest.h>

#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

/// Another server restores the session with the next epoch, and all clients join it. @return the former server's
/// session, still running
std::unique_ptr<Session> take_over(SessionFixture& rig, std::uint64_t key) {
  const Checkpoint from = rig.session->checkpoint();
  std::vector<std::unique_ptr<hal::SteppedDevice>> slaves;
  for (std::size_t j = 0; j < rig.scene.tools.size(); ++j)
    slaves.push_back(std::move(*hal::sim::SimDevice::make(
        {rig.scene.tools[j].slave, {}, rig.scene.tools[j].environment, nullptr, Time{}, from.tools[j].slave})));
  AxisArray scale;
  scale.fill(1);
  auto old = std::exchange(rig.session, std::make_unique<Session>(rig.scene, std::move(slaves), scale, from));
  for (std::size_t i = 0; i < rig.seats.size(); ++i) {
    FixtureSeat& s = rig.seats[i];
    const auto joined = netsim::simulate_join(*rig.session, rig.now, i, s.device->caps(), RandomKey{key}, i + 1);
    if (!joined) throw std::runtime_error("the new owner rejects all joins");
    s.params = joined->channel_params;
    s.core->reconnect(s.params);
  }
  return old;
}

// "Clients obey only the highest epoch; old keys do not open: 0 packets from the old epoch applied." Run twice: the
// former server receives none of the clients' datagrams, and it receives all of them. A twin has no former server:
// every byte and every hand must be equal.
TEST(SplitBrain, LeavesTheFormerServerWithoutEffect) {
  for (const bool hears : {false, true}) {
    SCOPED_TRACE(hears);
    SessionFixture rig("free_motion"), twin("free_motion");
    for (SessionFixture* r : {&rig, &twin}) r->run(2s);
    ASSERT_TRUE(rig.seats[0].core->gate().active()) << "no hand was engaged: the test proves nothing";
    const auto old = take_over(rig, 77);
    const auto gone = take_over(twin, 77);
    ASSERT_EQ(rig.session->epoch(), old->epoch() + 1);
    std::uint64_t from_old = 0, to_old = 0;
    std::array<std::byte, transport::kDatagramMax> buffer;
    const auto old_tick = [&] {
      old->on_tick(rig.now, 0);
      while (const auto due = old->poll_transmit(rig.now, buffer)) {
        ++from_old;
        const auto at = std::to_integer<std::uint8_t>(due->to.bytes[0]);
        client::Seat& core = *rig.seats[at - 1U].core;
        const std::uint64_t accepted = core.link().stats().accepted;
        Bytes d(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(due->size));
        core.on_datagram(rig.now, d);  // unchanged, and relabelled with the new connection's id
        transport::detail::put(&d[4], rig.seats[at - 1U].params.own_cid);
        core.on_datagram(rig.now, d);
        ASSERT_EQ(core.link().stats().accepted, accepted);
      }
    };
    const auto generations = [&] { return old->seat(0).generation() + old->seat(1).generation(); };
    const std::uint64_t acted = generations();
    for (int ms = 0; ms < 3000; ++ms) {
      for (std::size_t i = 0; i < rig.seats.size(); ++i)
        for (const Bytes& d : rig.client_tick(i)) {
          rig.session->on_datagram(rig.now, address(rig.seats[i].at), d);
          if (!hears) continue;
          ++to_old;
          for (const std::uint32_t cid : {rig.seats[i].params.peer_cid, old->seat(i).link()->own_cid()}) {
            Bytes copy = d;
            transport::detail::put(&copy[4], cid);
            old->on_datagram(rig.now, address(rig.seats[i].at), copy);
          }
        }
      old_tick();
      if (HasFatalFailure()) return;
      rig.to_clients(rig.server_tick());
      rig.now += 1ms;
      for (std::size_t i = 0; i < twin.seats.size(); ++i)
        for (const Bytes& d : twin.client_tick(i)) twin.session->on_datagram(twin.now, address(twin.seats[i].at), d);
      twin.to_clients(twin.server_tick());
      twin.now += 1ms;
    }
    EXPECT_GT(from_old, 3900U) << "the old owner sent nothing in the two seconds in which it sends to a silent client: "
                                  "the test proves nothing";
    EXPECT_EQ(to_old > 5000U, hears);
    EXPECT_EQ(generations(), acted) << "0 datagrams of the new epoch act at the old owner";
    EXPECT_EQ(rig.told.value, twin.told.value);
    EXPECT_EQ(rig.state_hash(), twin.state_hash());
    for (std::size_t i = 0; i < rig.seats.size(); ++i) {
      EXPECT_EQ(rig.seats[i].core->effort(), twin.seats[i].core->effort());
      EXPECT_EQ(rig.seats[i].core->gate().trips(), twin.seats[i].core->gate().trips());
    }
    EXPECT_EQ(rig.session->state(), wire::SessionState::kRunning);
    EXPECT_TRUE(rig.seats[0].core->gate().active()) << "they obey the new one";
  }
}

// All participants of a session read one time, and scripts follow it: the server's clock, which did not run during an
// outage. A participant's own hand continues to move meanwhile.
TEST(ServerTime, ExcludesTheOutageOfAResumedSession) {
  SessionFixture rig("free_motion");
  rig.run(2s);
  for (const FixtureSeat& s : rig.seats)
    EXPECT_EQ(s.core->clock().server_time(rig.now), s.core->clock().session_time(rig.now));
  rig.now += 5s;  // no server runs
  const auto old = take_over(rig, 78);
  for (const FixtureSeat& s : rig.seats)
    EXPECT_EQ(s.core->clock().server_time(rig.now), std::nullopt) << "it does not run yet";
  rig.run(2s);
  for (const FixtureSeat& s : rig.seats) {
    ASSERT_TRUE(s.core->clock().server_time(rig.now));
    EXPECT_NEAR(*s.core->clock().server_time(rig.now), rig.session->clock().time(), 0.003);
    EXPECT_GT(*s.core->clock().session_time(rig.now), *s.core->clock().server_time(rig.now) + 4.9);
  }
}

}  // namespace
}  // namespace tandem::server
