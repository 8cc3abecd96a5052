// Data that a session sheds at each shed level. Seats with a tool never get less frequent FORCE.
#include <gtest/gtest.h>

#include "server/policy/load_shedder.h"
#include "server/report/report.h"
#include "tests/server/session/session_fixture.h"
#include "tests/server/session/session_parts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using test::SessionFixture;

constexpr std::size_t kTrainee = 0, kEvaluator = 1, kObserver = 7,
                      kRequired = 6;  // seats of eight_seats, changed below

/// Eight seats: an active trainee, evaluators of which one is required, and an observer.
struct Eight : SessionFixture {
  Eight()
      : SessionFixture("eight_seats", 3, {}, 0, [](SceneSpec& s) {
          s.seats[kObserver].role = Role::kObserver;
          s.seats[kRequired].required = true;
        }) {
    run(2s);
  }
  /// FORCE datagrams per seat in one second, at a shed level.
  std::map<std::size_t, int> told_on(ShedLevel rung) {
    session->lifecycle().set_load_state({rung, false});
    run(10ms);
    forces.clear();
    run(1s);
    std::map<std::size_t, int> heard;
    for (std::size_t i = 0; i < seats.size(); ++i) heard[i] = forces[seats[i].at];
    return heard;
  }
};

TEST(LoadState, ShedsObserversThenEvaluatorsAndNeverSeatsThatHoldATool) {
  Eight eight;
  EXPECT_EQ(eight.session->state(), wire::SessionState::kRunning);
  struct Expected {
    ShedLevel rung;
    int evaluator, observer;
  };
  for (const auto& [rung, evaluator, observer] :
       {Expected{ShedLevel::kNone, 1000, 59}, Expected{ShedLevel::kTelemetry, 1000, 59},
        Expected{ShedLevel::kObservers20Hz, 1000, 20}, Expected{ShedLevel::kObservers10Hz, 1000, 10},
        Expected{ShedLevel::kEvaluatorsEvery2nd, 500, 10}, Expected{ShedLevel::kEvaluatorsEvery3rd, 333, 10},
        Expected{ShedLevel::kNewJoins, 333, 10}, Expected{ShedLevel::kNone, 1000, 59}}) {
    SCOPED_TRACE(to_text(rung));
    auto told = eight.told_on(rung);
    EXPECT_EQ(told[kTrainee], 1000);
    EXPECT_EQ(told[kRequired], 1000) << "a required evaluator";
    EXPECT_NEAR(told[kEvaluator], evaluator, 1);
    EXPECT_NEAR(told[kObserver], observer, 1);
  }
}

/// All in one tick would make that tick as long as before.
TEST(LoadState, StaggersSendsToEvaluatorsOverTicks) {
  Eight eight;
  eight.session->lifecycle().set_load_state({ShedLevel::kEvaluatorsEvery2nd, false});
  eight.run(10ms);
  for (int n = 0; n < 100; ++n) {
    eight.forces.clear();
    eight.run(1ms);
    int told = 0;
    for (std::size_t i = kEvaluator; i < kRequired; ++i) told += eight.forces[eight.seats[i].at];
    ASSERT_GE(told, 2);
    ASSERT_LE(told, 3) << "of five";
  }
}

/// A server that is late by one tick each time counts ticks in twos: no seat's turn may always fall between.
TEST(LoadState, ServesEverySeatWhenTicksAreMissed) {
  Eight eight;
  eight.session->lifecycle().set_load_state({ShedLevel::kEvaluatorsEvery3rd, false});
  for (const std::uint32_t stride : {2u, 3u, 4u, 6u}) {
    eight.forces.clear();
    for (int n = 0; n < 120; ++n) {
      for (std::uint32_t k = 1; k < stride; ++k) {
        for (std::size_t i = 0; i < eight.seats.size(); ++i)
          for (const auto& d : eight.client_tick(i))
            eight.session->on_datagram(eight.now, test::address(eight.seats[i].at), d);
        eight.now += 1ms;
      }
      for (std::size_t i = 0; i < eight.seats.size(); ++i)
        for (const auto& d : eight.client_tick(i))
          eight.session->on_datagram(eight.now, test::address(eight.seats[i].at), d);
      eight.session->on_tick(eight.now, stride - 1);
      eight.to_clients(eight.server_sends());
      eight.now += 1ms;
    }
    for (std::size_t i = kEvaluator; i < kRequired; ++i)
      EXPECT_GE(eight.forces[eight.seats[i].at], stride == 2 ? 79 : 119) << i << " of a tick in " << stride;
  }
}

TEST(LoadState, KeepsTheSendRateOfSlowSessions) {
  for (const auto& [hz, most] : {std::pair{1000.0, 3u}, {500.0, 1u}, {4000.0, 3u}}) {
    test::SessionParts parts("eight_seats");
    parts.scene.tick_hz = hz;
    const SendSchedule schedule(parts.scene, parts.seats);
    EXPECT_EQ(schedule.interval(kEvaluator, ShedLevel::kEvaluatorsEvery3rd), most)
        << "six intervals fit into 20 ms at " << hz;
  }
}

/// A report of a server that omitted nine of ten records: the same times and means.
TEST(LoadState, ReportsTheSameTimesAndMeansFromATenthOfTheRecords) {
  const SceneSpec scene = *parse_scene(find_shipped_scene("one_axis")->text, "one_axis.textproto");
  ReportBuilder all{scene}, tenth{scene};
  for (std::uint32_t tick = 1; tick <= 1000; ++tick) {
    TickRecord record;
    record.tick = tick;
    record.running = true;
    record.seats[0].alpha = tick <= 500 ? 1 : 0;
    record.tools[0].held = tick > 800;
    all.add(record);
    if (tick % 10 == 1) tenth.add(record);
  }
  const std::vector<LinkReport> links(scene.seats.size());
  const RunReport a = all.build(links), b = tenth.build(links);
  EXPECT_DOUBLE_EQ(a.duration_s, 1.0);
  EXPECT_DOUBLE_EQ(a.tools[0].held_s, 0.2);
  EXPECT_NEAR(b.duration_s, a.duration_s, 0.010);
  EXPECT_NEAR(b.tools[0].held_s, a.tools[0].held_s, 0.010);
  EXPECT_NEAR(a.seats[0].alpha_mean, 0.5, 1e-9);
  EXPECT_NEAR(b.seats[0].alpha_mean, 0.5, 0.011);
}

TEST(LoadState, TakesNoHeap) {
  SessionFixture rig{"one_axis"};
  rig.run(1s);
  for (const bool passive : {true, false}) {
    std::array<std::byte, transport::kDatagramMax> buffer;
    const tandem::test::AllocGuard guard;
    rig.session->lifecycle().set_load_state({ShedLevel::kEvaluatorsEvery2nd, passive});
    rig.session->on_tick(rig.now, 0);
    while (rig.session->poll_transmit(rig.now, buffer)) {
    }
    EXPECT_EQ(guard.count(), 0u);
    rig.now += 1ms;
  }
}

}  // namespace
}  // namespace tandem::server
