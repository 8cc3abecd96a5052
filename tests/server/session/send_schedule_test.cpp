// How often each seat receives a datagram; tests/server/session/load_state_test.cpp counts what real clients receive.
#include "server/session/send_schedule.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using test::SessionParts;
using enum ShedLevel;

TEST(SendSchedule, SpacesObserversByShedLevel) {
  SessionParts parts("free_motion", [](SceneSpec& scene) { scene.seats[1].role = Role::kObserver; });
  const SendSchedule schedule(parts.scene, parts.seats);
  for (const ShedLevel level : {kNone, kObservers20Hz, kObservers10Hz, kNewJoins})
    EXPECT_EQ(schedule.interval(0, level), 1u) << "an instructor";
  EXPECT_EQ(schedule.interval(1, kNone), 17u) << "1000 Hz / 60 Hz, rounded up";
  EXPECT_EQ(schedule.interval(1, kTelemetry), 17u);
  EXPECT_EQ(schedule.interval(1, kObservers20Hz), 51u);
  EXPECT_EQ(schedule.interval(1, kObservers10Hz), 102u);
  EXPECT_EQ(schedule.interval(1, kNewJoins), 102u);
}

TEST(SendSchedule, SpacesOnlyEvaluatorsThatAreNotRequired) {
  SessionParts parts("eight_seats", [](SceneSpec& scene) { scene.seats[2].required = true; });
  const SendSchedule schedule(parts.scene, parts.seats);
  for (const auto& [level, interval] : {std::pair{kNone, 1u},
                                        {kObservers10Hz, 1u},
                                        {kEvaluatorsEvery2nd, 2u},
                                        {kEvaluatorsEvery3rd, 3u},
                                        {kNewJoins, 3u}}) {
    EXPECT_EQ(schedule.interval(0, level), 1u) << "the trainee";
    EXPECT_EQ(schedule.interval(1, level), interval);
    EXPECT_EQ(schedule.interval(2, level), 1u) << "a required evaluator";
  }
}

TEST(SendSchedule, HasNothingDueForSeatsWithoutAClient) {
  SessionParts parts("free_motion");
  SendSchedule schedule(parts.scene, parts.seats);
  CloseOuts closing;
  closing.session.begin(wire::CloseReason::kDone, 0.001);
  std::array<std::byte, transport::kDatagramMax> buffer;
  for (std::uint32_t tick = 0; tick < 200; ++tick) {
    schedule.begin_tick(Time{} + tick * parts.clock.tick_length(), tick, kNone, closing);
    EXPECT_FALSE(schedule.poll(Time{}, tick, closing, buffer));
    closing.session.step();
  }
}

}  // namespace
}  // namespace tandem::server
