// States of a session, its overload events and its end. Whole sessions: session_clock_test.cpp.
#include "server/session/session_lifecycle.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using test::SessionParts;
using State = wire::SessionState;
using What = AuditEvent::What;

/// Two ticks long, without clients: its tools are braked.
struct Living : SessionParts {
  Living()
      : SessionParts("free_motion", [](SceneSpec& changed) {
          changed.duration = 2 / changed.tick_hz;
          changed.clock_runs_while_stopped = false;
        }) {}
  /// Advances by one tick. @return the state then
  State step() {
    lifecycle.report_changes({});
    lifecycle.step({}, tools);
    return lifecycle.state();
  }
  Participants participants{seats, clock, audit};
  StartCondition start{scene, seats, present, clock};
  StopControl stop{scene, participants, start, audit};
  SessionLifecycle lifecycle{scene, clock, participants, start, stop, audit};
};

TEST(SessionLifecycle, WaitsThenRunsAndEndsAtTheDurationOfTheScene) {
  Living s;
  EXPECT_EQ(s.step(), State::kWaiting);
  EXPECT_FALSE(s.lifecycle.disengages_all());
  s.start.begin({});
  EXPECT_EQ(s.lifecycle.state(), State::kRunning) << "nothing is known about the tools yet";
  EXPECT_EQ(s.step(), State::kHeld);
  EXPECT_EQ(s.clock.session_tick(), 1U);
  EXPECT_EQ(s.step(), State::kEnding);
  EXPECT_TRUE(s.lifecycle.ending() && s.lifecycle.disengages_all() && s.lifecycle.clock_stopped());
  EXPECT_EQ(s.step(), State::kEnding);
  EXPECT_EQ(s.clock.session_tick(), 2U);
}

TEST(SessionLifecycle, StopsTheClockWhileTheSessionIsStopped) {
  Living s;
  s.start.begin({});
  ASSERT_TRUE(s.stop.request({}, {AccessRole::kOperator}));
  EXPECT_EQ(s.step(), State::kStopped);
  EXPECT_TRUE(s.lifecycle.disengages_all() && s.lifecycle.clock_stopped());
  EXPECT_EQ(s.clock.session_tick(), 0U);
  EXPECT_EQ(s.clock.stopped_ticks(), 1U);
  ASSERT_EQ(s.stop.resume({}, {AccessRole::kOperator}, 1), CommandResult::kDone);
  EXPECT_EQ(s.step(), State::kHeld);
  EXPECT_EQ(s.clock.session_tick(), 1U);
}

TEST(SessionLifecycle, ReportsBeginAndEndOfAnOverloadOnceTheSessionRuns) {
  Living s;
  s.lifecycle.set_load_state({ShedLevel::kNewJoins, true});
  EXPECT_EQ(s.step(), State::kWaiting);
  EXPECT_TRUE(s.lifecycle.disengages_all());
  EXPECT_TRUE(s.events().empty());
  s.start.begin({});
  EXPECT_EQ(s.step(), State::kOverloaded);
  s.lifecycle.report_changes({});
  auto events = s.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].what, What::kOverload);
  EXPECT_EQ(events[0].seat, AuditEvent::kNoSeat);
  s.lifecycle.set_load_state({});
  s.lifecycle.report_changes({});
  events = s.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].what, What::kOverloadCleared);
}

TEST(SessionLifecycle, DisengagesAllWhileTheServerMayNotAct) {
  Living s;
  s.lifecycle.set_may_act(false);
  EXPECT_EQ(s.step(), State::kWaiting);
  EXPECT_TRUE(s.lifecycle.disengages_all());
  EXPECT_TRUE(s.events().empty()) << "nothing runs yet";
  s.start.begin({});
  EXPECT_EQ(s.lifecycle.state(), State::kHeld);
  s.lifecycle.report_changes({});
  s.lifecycle.report_changes({});
  auto events = s.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].what, What::kLeaseDoubtful);
  EXPECT_FALSE(s.lifecycle.clock_stopped()) << "the session's time goes on, as in an overload";
  s.lifecycle.set_may_act(true);
  EXPECT_FALSE(s.lifecycle.disengages_all());
  s.lifecycle.report_changes({});
  events = s.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].what, What::kLeaseRenewed);
}

}  // namespace
}  // namespace tandem::server
