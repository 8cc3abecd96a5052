// Session clock and timeline while the session is stopped; effects on hands, checkpoints and reports.
#include <gtest/gtest.h>

#include <cmath>

#include "server/report/report.h"
#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

/// Free motion whose scene moves the authority early, so that a test is short.
struct Stoppable : SessionFixture {
  explicit Stoppable(bool runs_on = false)
      : SessionFixture("free_motion", 3, {}, 0,
                       runs_on ? +[](SceneSpec& s) { change(s), s.clock_runs_while_stopped = true; } : change) {}
  static void change(SceneSpec& s) {
    s.timeline.front().at = 3;
    s.duration = 60;
  }
  void until(double t) {
    for (int n = 0; session->clock().time() < t && n < 20'000; ++n) step();
    ASSERT_GE(session->clock().time(), t);
  }
  void step() {
    tick([] {});
    builder.add(session->record());
  }
  void steps(int n) {
    for (int i = 0; i < n; ++i) step();
  }
  void resume() {
    ASSERT_EQ(session->stop_control().resume(now, {AccessRole::kInstructor}, session->stop_control().latch().stops()),
              CommandResult::kDone);
  }
  [[nodiscard]] bool to_trainee() const { return session->tool(0).authority.requested()[kTrainee] == 1; }
  [[nodiscard]] double time_of(std::size_t i) const { return seats[i].core->clock().server_time(now).value_or(-1); }
  [[nodiscard]] RunReport report() const { return builder.build(std::vector<LinkReport>(scene.seats.size())); }

  ReportBuilder builder{scene};
};

TEST(SessionClock, GivesEachTickANumberOfItsOwnAtAnyTurnWithinTheTick) {
  for (const Duration turn : {100us, 500us, 900us}) {
    SessionClock clock{1000};
    const Time begin{1h};
    clock.begin_tick(begin, 0);
    EXPECT_EQ(clock.tick(), 0U);
    for (std::uint32_t n = 1; n <= 1000; ++n) {
      const std::uint32_t before = clock.tick();
      clock.begin_tick(begin + n * 1ms + turn + (n % 2 == 0 ? 20us : -20us), 0);
      EXPECT_GT(clock.tick(), before) << n;
      EXPECT_LE(clock.tick(), n + 1);
    }
    clock.begin_tick(begin + 2s, 999);
    EXPECT_EQ(clock.tick(), 2000U) << "it follows the time";
  }
}

TEST(SessionClock, StopsWithItsTimelineWhileTheSessionIsStopped) {
  for (const bool paused : {false, true}) {
    SCOPED_TRACE(paused ? "paused" : "stopped");
    Stoppable s;
    s.until(2.5);
    ASSERT_TRUE(paused ? s.session->stop_control().request(s.now, {AccessRole::kInstructor}, StopLatch::Level::kPaused)
                       : s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
    s.step();
    const std::uint32_t stood_at = s.session->clock().session_tick();
    s.steps(2000);  // past 3 s, where the timeline moves the authority
    EXPECT_EQ(s.session->clock().session_tick(), stood_at);
    EXPECT_TRUE(s.session->lifecycle().clock_stopped());
    EXPECT_FALSE(s.to_trainee());
    EXPECT_EQ(s.session->checkpoint().session_tick, stood_at);
    for (const std::size_t i : {kTrainer, kTrainee}) {
      EXPECT_DOUBLE_EQ(s.time_of(i), stood_at * 1e-3) << "clients show the same time";
      EXPECT_DOUBLE_EQ(*s.seats[i].core->clock().session_time(s.now), stood_at * 1e-3);
    }
    s.resume();
    s.until(2.9);
    EXPECT_FALSE(s.to_trainee());
    EXPECT_NEAR(s.time_of(kTrainee), s.session->clock().time(), 0.0021)
        << "the clients' clocks go on with the server's";
    s.until(3.01);
    EXPECT_TRUE(s.to_trainee()) << "at its time on the session clock";
    EXPECT_NEAR(static_cast<double>(s.session->clock().stopped_ticks()), 2001, 2);
  }
}

TEST(SessionClock, ContinuesDuringAStopIfTheSceneRequestsIt) {
  Stoppable s{true};
  s.until(2.5);
  ASSERT_TRUE(s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
  s.steps(2000);
  EXPECT_NEAR(s.session->clock().time(), 4.5, 0.002);
  EXPECT_TRUE(s.to_trainee());
  EXPECT_NEAR(s.time_of(kTrainer), s.session->clock().time(), 0.0021);
  EXPECT_EQ(s.session->clock().stopped_ticks(), 0u);
}

TEST(SessionClock, DefersAnAnnouncedTimelineChangeButNoParticipantsRequest) {
  Stoppable s;
  s.until(2.97);  // 30 ms before the scene's change, which is announced now
  ASSERT_EQ(s.session->tool(0).transfer.latest_by(), AuditEvent::kTimeline);
  const std::uint32_t left = s.session->tool(0).transfer.ticks_left();
  ASSERT_TRUE(s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
  s.steps(500);
  EXPECT_EQ(s.session->tool(0).transfer.ticks_left(), left);
  EXPECT_FALSE(s.to_trainee());
  wire::AuthorityMessage wish{
      .version = s.session->authority().version(), .tool = 0, .masters = 2, .alpha = {0.5, 0.5}};
  ASSERT_EQ(s.session->authority().request(s.now, {AccessRole::kInstructor, kTrainer, 0}, wish), CommandResult::kDone);
  s.steps(51);
  EXPECT_EQ(s.session->tool(0).authority.requested()[kTrainee], 0.5) << "the newest decision is the last to act";
}

/// The session that a restarted server makes of `from`: no client has joined and no slave moves.
Session restored(const SceneSpec& scene, const Checkpoint& from) {
  AxisArray scale;
  scale.fill(1);
  return {scene, std::vector<std::unique_ptr<hal::SteppedDevice>>(scene.tools.size()), scale, from};
}

TEST(SessionClock, StopsDuringTheCloseOutSoThatARestartSkipsNothing) {
  for (const bool stopped : {false, true}) {
    SCOPED_TRACE(stopped ? "stopped before" : "running before");
    Stoppable s;
    s.until(2.9);
    if (stopped) {
      ASSERT_TRUE(s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
      s.steps(100);
    }
    const std::uint32_t ended_at = s.session->clock().session_tick();
    s.session->participants().end(wire::CloseReason::kServerReturns);
    for (int n = 0; n < 1000 && !s.session->over(); ++n) s.step();
    ASSERT_TRUE(s.session->over());
    const Checkpoint last = s.session->checkpoint();
    EXPECT_EQ(last.session_tick, ended_at);

    Session next = restored(s.scene, last);
    ASSERT_EQ(next.stop_control().resume(s.now, {AccessRole::kInstructor}, next.stop_control().latch().stops()),
              CommandResult::kDone)
        << "resumes without participants";
    if (stopped) {
      ASSERT_EQ(next.stop_control().resume(s.now, {AccessRole::kInstructor}, next.stop_control().latch().stops()),
                CommandResult::kDone)
          << "it was stopped, and still is";
    }
    for (int n = 0; n < 200; ++n, s.now += 1ms) next.on_tick(s.now, 0);
    EXPECT_EQ(next.tool(0).transfer.scheduled()[kTrainee], 1) << "the scene's change at 3 s was still to come";
  }
}

TEST(SessionClock, DoesNotRunInReportsBeforeARestoredSessionResumes) {
  Stoppable s;
  s.until(2);
  Session next = restored(s.scene, s.session->checkpoint());
  const auto runs = [&] {
    next.on_tick(s.now += 1ms, 0);
    return next.record().running;
  };
  EXPECT_FALSE(runs()) << "it waits for the required seats";
  ASSERT_TRUE(next.stop_control().request(s.now, {AccessRole::kInstructor}));
  EXPECT_FALSE(runs()) << "it waits for the required seats, and is stopped";
  ASSERT_TRUE(next.start_condition().recovering());
  ASSERT_EQ(next.stop_control().resume(s.now, {AccessRole::kInstructor}, next.stop_control().latch().stops()),
            CommandResult::kDone);  // ends the stop
  ASSERT_EQ(next.stop_control().resume(s.now, {AccessRole::kInstructor}, next.stop_control().latch().stops()),
            CommandResult::kDone);  // ends the recovery
  EXPECT_TRUE(runs());
  ASSERT_FALSE(next.start_condition().recovering());
}

TEST(SessionClock, AgreesWithAClientThatMissedAStop) {
  Stoppable s;
  s.until(2);
  const auto server_only = [&] {
    for (std::size_t i = 0; i < s.seats.size(); ++i)
      for (const Bytes& d : s.client_tick(i)) s.session->on_datagram(s.now, address(s.seats[i].at), d);
    static_cast<void>(s.server_tick());  // its datagrams are not delivered to the clients
    s.now += 1ms;
  };
  ASSERT_TRUE(s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
  for (int n = 0; n < 300; ++n) server_only();
  s.resume();
  s.until(2.5);
  EXPECT_NEAR(s.time_of(kTrainer), s.session->clock().time(), 0.0021) << "although no FORCE contained STOPPED";
}

TEST(SessionClock, ExcludesStopsFromDurationsAndSpeedsOfAReport) {
  Stoppable s;
  s.until(2.5);
  ASSERT_TRUE(s.session->stop_control().request(s.now, {AccessRole::kInstructor}));
  s.steps(2000);
  s.resume();
  s.until(5);
  const RunReport r = s.report();
  EXPECT_NEAR(r.duration_s, 5, 0.01);
  EXPECT_NEAR(r.stopped_s, 2, 0.01);
  EXPECT_LT(r.judged_s, r.duration_s - 1.9) << "a second after the beginning and one after the stop are not judged";
  EXPECT_GT(r.judged_s, 1.5);
  EXPECT_LT(r.seats[kTrainer].metrics.speed_peak_m_s, 0.6) << "while the clock is stopped a difference is no speed";
}

// ---- The clock alone ----

TEST(SessionTicks, FollowTheTimeAndDropMissedTicksAboveFifty) {
  SessionClock clock(500);
  EXPECT_EQ(clock.tick_length(), 2ms);
  const Time start{1h};
  EXPECT_EQ(clock.begin_tick(start, 0), 0u);
  EXPECT_EQ(clock.tick(), 0u);
  EXPECT_EQ(clock.begin_tick(start + 100ms, 49), 49u);
  EXPECT_EQ(clock.tick(), 50u);
  EXPECT_EQ(clock.dropped_ticks(), 0u);
  EXPECT_EQ(clock.begin_tick(start + 300ms, 99), 50u);
  EXPECT_EQ(clock.tick(), 150u);
  EXPECT_EQ(clock.dropped_ticks(), 49u);
  EXPECT_EQ(clock.last_tick(), start + 300ms);
  EXPECT_EQ(clock.session_tick(), 0u) << "the session has not begun";
  EXPECT_EQ(clock.begin_step(), 0ms) << "nothing precedes the first tick";
  EXPECT_EQ(clock.begin_step(), 2ms);
}

TEST(SessionTicks, CountRunningAndStoppedTicksApart) {
  SessionClock clock(500);
  clock.restore(100);
  EXPECT_FALSE(clock.begun());
  EXPECT_EQ(clock.time(), 0.2);
  clock.resume();
  for (const bool stopped : {false, true, true, false, false}) clock.advance(stopped);
  EXPECT_TRUE(clock.begun());
  EXPECT_EQ(clock.session_tick(), 103u);
  EXPECT_EQ(clock.stopped_ticks(), 2u);
  clock.begin();
  EXPECT_EQ(clock.session_tick(), 0u);
}

TEST(SessionClock, StandsStillAtItsLastTickAndDoesNotBeginAgain) {
  SessionClock clock(1000);
  clock.restore(SessionClock::kTickMax - 2);
  clock.resume();
  double before = clock.time();
  for (int i = 0; i < 5; ++i) {
    clock.advance(false);
    EXPECT_GE(clock.time(), before);
    before = clock.time();
  }
  EXPECT_EQ(clock.session_tick(), SessionClock::kTickMax);
}

TEST(AuditTrail, StampsEventsWithTheSessionsTick) {
  SessionClock clock(1000);
  AuditTrail audit(clock);
  clock.restore(41);
  clock.resume();
  clock.advance(false);
  audit.emit(Time{3s}, AuditEvent::What::kStop, 2, 9);
  const auto event = audit.poll();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->tick, 42u);
  EXPECT_EQ(event->at, Time{3s});
  EXPECT_EQ(event->seat, 2);
  EXPECT_EQ(event->version, 9u);
  EXPECT_FALSE(audit.poll());
  for (std::size_t n = 0; n < AuditQueue::kCapacity + 3; ++n) audit.emit(Time{}, AuditEvent::What::kLoss, 0);
  EXPECT_EQ(audit.dropped(), 3u);
}

TEST(SessionRecord, IsMadeAtEveryTickUntilTheSessionRunsAndAtEveryNthThen) {
  Stoppable s;
  s.session->set_record_interval(17);
  std::vector<std::uint32_t> at;  // ticks since the first record of the running session
  std::uint32_t waited = 0, running = 0;
  for (std::uint32_t n = 0; n < 3000 && running < 60; ++n) {
    const std::uint32_t before = s.session->record().tick;
    s.tick([] {});
    const bool recorded = s.session->recorded();
    if (!s.session->record().running) {
      EXPECT_TRUE(recorded) << "before the session runs";
      ++waited;
      continue;
    }
    if (recorded) {
      at.push_back(running);
      EXPECT_EQ(s.session->record().tick, s.session->clock().session_tick());
    } else {
      EXPECT_EQ(s.session->record().tick, before) << "the record is that of an earlier tick";
    }
    ++running;
  }
  EXPECT_GT(waited, 0u);
  EXPECT_EQ(at, (std::vector<std::uint32_t>{0, 17, 34, 51}));
  s.session->set_record_interval(1);
  s.tick([] {});
  EXPECT_TRUE(s.session->recorded());
}

}  // namespace
}  // namespace tandem::server
