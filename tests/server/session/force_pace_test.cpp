#include "server/session/force_pace.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

namespace tandem::server {
namespace {

/// The FORCE of an engaged seat at rest that follows.
struct AtRest {
  explicit AtRest(double assist = 0) {
    SeatSetup setup;
    setup.channel.law = LawKind::kReplica;
    setup.channel.e0 = 0.05;
    setup.send.dead_band.emplace();
    setup.send.heartbeat = 0.016;
    setup.seat.assist.force = assist;
    pace.emplace(setup);
    static_cast<void>(sent(100));
  }
  int sent(int ticks) {
    int n = 0;
    for (int i = 0; i < ticks; ++i, ++tick) {
      if (!pace->due(tick, force, {}, engaged, heard)) continue;
      pace->sent(tick, force, {});
      ++n;
    }
    return n;
  }
  std::optional<ForcePace> pace;
  wire::ForceMessage force;
  PortSample heard;
  bool engaged = true;
  std::uint32_t tick = 0;
};

TEST(ForcePace, SendsHeartbeatsToASeatAtRestAndEveryTickToOneThatIsNotEngaged) {
  AtRest seat;
  EXPECT_EQ(seat.sent(1600), 100);
  seat.engaged = false;
  EXPECT_EQ(seat.sent(100), 100);
}

TEST(ForcePace, RepeatsEveryChangeThatMustNotWait) {
  const std::function<void(wire::ForceMessage&)> kChanges[] = {
      [](auto& f) { f.session = wire::SessionState::kStopped; },
      [](auto& f) { f.engage = true; },
      [](auto& f) { f.authority_version = 1; },
      [](auto& f) { f.missing = 1; },
      [](auto& f) { f.stops = 1; },
      [](auto& f) { f.transfer = wire::TransferNotice::kGaining; },
      [](auto& f) { f.transfer_ticks = 3; },
      [](auto& f) { f.transfer_parties.to = 1; },
      [](auto& f) { f.touching = true; },
      [](auto& f) { f.telemetry_every_tick = false; },
      [](auto& f) { f.ghost.leader = 2; },
      [](auto& f) { f.alpha = 1e-9; },
      [](auto& f) { f.slave_pull = 0.1; },
      [](auto& f) { f.contacts.add({.id = 1}); }};
  for (std::size_t i = 0; i < std::size(kChanges); ++i) {
    SCOPED_TRACE(i);
    AtRest seat;
    kChanges[i](seat.force);
    EXPECT_EQ(seat.sent(10), 10);
    EXPECT_EQ(seat.sent(16), 1);
  }
}

// The server filters the delays from which this fraction follows, so it moves a little at every tick.
TEST(ForcePace, RepeatsNoSlowChangeOfTheSlavesPull) {
  AtRest seat;
  seat.force.slave_pull = 0.5;
  static_cast<void>(seat.sent(26));
  int sent = 0;
  for (int tick = 0; tick < 160; ++tick) {
    seat.force.slave_pull += 1e-6;
    sent += seat.sent(1);
  }
  EXPECT_EQ(sent, 10) << "heartbeats";
  seat.force.slave_pull += 0.02;
  EXPECT_EQ(seat.sent(10), 10);
  static_cast<void>(seat.sent(16));
  seat.force.slave_pull = 0;
  EXPECT_EQ(seat.sent(10), 10) << "the slave no longer pulls";
}

TEST(ForcePace, SendsAgainWhatTheSocketDidNotTake) {
  AtRest seat;
  seat.force.stops = 1;
  EXPECT_TRUE(seat.pace->due(seat.tick, seat.force, {}, true, seat.heard));
  for (std::uint32_t later = 1; later < 100; ++later)  // `sent` is never called
    EXPECT_TRUE(seat.pace->due(seat.tick + later, seat.force, {}, true, seat.heard));
}

TEST(ForcePace, IgnoresTargetsOfAHandThatLeadsAloneAndTheGhostWithoutAssist) {
  AtRest leads, follows, watches, assisted(1);
  leads.force.alpha = 1;
  for (AtRest* const seat : {&leads, &follows, &watches, &assisted}) static_cast<void>(seat->sent(26));
  leads.force.port.x[0] = follows.force.port.x[0] = 0.01;
  watches.force.ghost.x[0] = assisted.force.ghost.x[0] = 0.01F;
  EXPECT_EQ(leads.sent(1), 0);
  EXPECT_EQ(follows.sent(1), 1);
  EXPECT_EQ(watches.sent(1), 0);
  EXPECT_EQ(assisted.sent(1), 1);
}

TEST(ForcePace, SendsEnergyThatTheClientMaySpend) {
  AtRest seat;
  static_cast<void>(seat.sent(3));
  seat.force.port.e_in[0] = 5'000'000;  // a tenth of 50 mJ
  EXPECT_EQ(seat.sent(1), 0);
  seat.force.port.e_in[0] = 5'000'001;
  EXPECT_EQ(seat.sent(1), 1);
}

}  // namespace
}  // namespace tandem::server
