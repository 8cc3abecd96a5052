// A silent client: FORCE ends 2 s after its last STATE, a keep-alive of 1 Hz follows for 60 s, then nothing is sent.
// The client comes back at any time by sending STATE.
#include <gtest/gtest.h>

#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

void endless(SceneSpec& scene) { scene.duration = 3600; }

/// Seat 0 ticks and receives, but its datagrams are lost; the other seats are unaffected. @return times at which it
/// received something, since the begin [ms]
std::vector<int> cut_off(SessionFixture& rig, int milliseconds) {
  std::vector<int> told;
  for (int ms = 0; ms < milliseconds; ++ms) {
    for (std::size_t i = 0; i < rig.seats.size(); ++i)
      for (const Bytes& d : rig.client_tick(i))
        if (i > 0) rig.session->on_datagram(rig.now, address(rig.seats[i].at), d);
    const auto sent = rig.server_tick();
    for (const auto& [to, bytes] : sent)
      if (to == rig.seats[0].at) told.push_back(ms);
    rig.to_clients(sent);
    rig.now += 1ms;
  }
  return told;
}

TEST(SilentPeer, GetsForceForTwoSecondsThenOneDatagramASecondForAMinuteThenNothing) {
  SessionFixture rig("one_axis", 3, {}, 0, endless);
  rig.run(1s);
  const std::vector<int> told = cut_off(rig, 70'000);
  const auto between = [&](int from, int to) {
    return std::ranges::count_if(told, [&](int ms) { return ms >= from && ms < to; });
  };
  EXPECT_GE(between(0, 1999), 1998);
  EXPECT_LE(between(2001, 62'001), 60);
  EXPECT_GE(between(2001, 62'001), 59);
  EXPECT_EQ(between(62'001, 70'000), 0);
  int last = -1;
  for (const int ms : told) {
    if (ms > 2001 && last >= 0) {
      EXPECT_GE(ms - last, 1000);
    }
    last = ms;
  }
}

TEST(SilentPeer, ReceivesForcesAgainAsSoonAsItSends) {
  for (const int silent : {2500, 30'000, 70'000}) {
    SCOPED_TRACE(silent);
    SessionFixture rig("one_axis", 3, {}, 0, endless);
    rig.run(3s);
    ASSERT_TRUE(rig.seats[0].core->gate().active());
    static_cast<void>(cut_off(rig, silent));
    EXPECT_FALSE(rig.seats[0].core->gate().active());
    const int before = rig.forces[1];
    rig.run(100ms);
    EXPECT_GE(rig.forces[1] - before, 99);
    rig.run(3s);
    EXPECT_TRUE(rig.seats[0].core->gate().active()) << "engaged again, on the same connection";
  }
}

TEST(SilentPeer, DetectsThatTheServerDoesNotReceiveItsDatagrams) {
  SessionFixture rig("one_axis", 3, {}, 0, endless);
  rig.run(1s);
  const transport::LinkTiming& fresh = rig.seats[0].core->link().timing();
  EXPECT_LE(fresh.unanswered_for(rig.now), 2ms);
  const Time cut = rig.now;
  bool spoke = false;
  for (int ms = 0; ms < 10'000; ++ms) {
    static_cast<void>(cut_off(rig, 1));
    spoke = spoke || (rig.now - cut > 3s && fresh.silence(rig.now) < 10ms);
    ASSERT_NEAR(seconds(fresh.unanswered_for(rig.now)), seconds(rig.now - cut), 0.002);
  }
  EXPECT_TRUE(spoke) << "else there is nothing to judge";
  rig.run(5ms);
  EXPECT_LE(fresh.unanswered_for(rig.now), 2ms);
}

TEST(SilentPeer, IsThrottledAsAnObserverToo) {
  constexpr std::size_t observer = 1;
  SessionFixture rig("free_motion", 3, {}, 0, [](SceneSpec& scene) {
    scene.seats[observer].role = Role::kObserver;
    scene.seats[observer].required = false;
    endless(scene);
  });
  rig.run(500ms);
  int told = 0;
  for (int ms = 0; ms < 10'000; ++ms) {
    for (std::size_t i = 0; i < rig.seats.size(); ++i)
      for (const Bytes& d : rig.client_tick(i))
        if (i != observer) rig.session->on_datagram(rig.now, address(rig.seats[i].at), d);
    for (const auto& [to, bytes] : rig.server_tick())
      if (to == rig.seats[observer].at && ms > 2001) ++told;
    rig.now += 1ms;
  }
  EXPECT_LE(told, 8);
  EXPECT_GE(told, 7);
}

TEST(SilentPeer, ReceivesTheCloseWithinAMinuteOfSilence) {
  for (const auto& [silent, said] : {std::pair{10'000, true}, std::pair{63'000, false}}) {
    SessionFixture rig("one_axis", 3, {}, 0, endless);
    rig.run(1s);
    static_cast<void>(cut_off(rig, silent));
    rig.session->participants().end(wire::CloseReason::kServerStops);
    EXPECT_EQ(!cut_off(rig, 300).empty(), said) << silent;
  }
}

}  // namespace
}  // namespace tandem::server
