// A running session as a lesson at the rate of telemetry.
#include "server/console/live_lesson.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/io/recording_samples.h"

namespace tandem::console {
namespace {

LivePicture picture(std::uint32_t tick, wire::SessionState state = wire::SessionState::kRunning) {
  LiveValues live;
  live.telemetry.session_tick = tick;
  live.telemetry.state = state;
  live.telemetry.seats[0] = {.taken = true,
                             .heard = true,
                             .engaged = true,
                             .stopped = false,
                             .gate = wire::GateState::kActive,
                             .x = {1e-3 * tick, 0, 0},
                             .f = {0, 2, 0}};
  live.telemetry.seats[1] = live.telemetry.seats[0];
  live.telemetry.seats[1].heard = false;
  live.telemetry.tools[0].x = {1, 2, 3};
  live.authorities[0].applied = {0.75, 0.25};
  LivePicture out;
  out.number = 1;
  out.status.name = "lab";
  out.live = std::make_shared<const LiveValues>(live);
  return out;
}

TEST(LiveLessons, HaveTheTicksOfTelemetry) {
  LiveLesson live(server::test::scene_named("contact"));
  for (std::uint32_t k = 0; k < 100; ++k) live.add(picture(17 * k + 3));
  const Lesson& lesson = live.lesson();
  EXPECT_NEAR(lesson.scene.tick_hz, 1000.0 / 17, 1e-9);
  ASSERT_EQ(lesson.rows(), 100u);
  for (std::uint32_t k = 0; k < 100; ++k) ASSERT_EQ(lesson.tick[k], k) << "no tick is missing";
  EXPECT_EQ(lesson.seats[0].x[10][0], 1e-3 * 173);
  EXPECT_EQ(lesson.tools[0].alpha[10][0], 0.75);
  EXPECT_TRUE(std::isnan(lesson.seats[1].x[10][0])) << "a seat that is not heard has no sample";
  EXPECT_TRUE(lesson.seats[0].f_cmd.empty()) << "telemetry does not have it";
}

TEST(LiveLessons, CountALostDatagramAsAMissingTick) {
  LiveLesson live(server::test::scene_named("contact"));
  for (const std::uint32_t k : {0u, 1u, 4u}) live.add(picture(17 * k));
  EXPECT_EQ(live.lesson().tick, (std::vector<std::uint32_t>{0, 1, 4}));
  live.add(picture(17 * 4 + 1));
  EXPECT_EQ(live.lesson().rows(), 3u) << "the same period again";
}

TEST(LiveLessons, BeginAStretchAfterAPauseAndANewLessonAfterARestart) {
  LiveLesson live(server::test::scene_named("contact"));
  live.add(picture(0));
  live.add(picture(17, wire::SessionState::kPaused));
  live.add(picture(17));
  EXPECT_EQ(live.lesson().stopped_ticks, (std::vector<std::uint64_t>{0, 1}));
  live.add(picture(0));
  EXPECT_EQ(live.lesson().rows(), 1u) << "the session began again";
  EXPECT_EQ(live.lesson().seats[0].x.size(), 1u);
}

TEST(LiveLessons, KeepABoundedNumberOfRows) {
  LiveLesson live(server::test::scene_named("eight_seats"));
  const std::uint32_t n = 2 * static_cast<std::uint32_t>(LiveLesson::kRowsMax);
  for (std::uint32_t k = 0; k < n; ++k) live.add(picture(17 * k));
  const Lesson& lesson = live.lesson();
  EXPECT_LE(lesson.rows(), LiveLesson::kRowsMax);
  EXPECT_LE(lesson.rows() * 8 * (24 + 24 + 2 + 8), LiveLesson::kBytesMax);
  EXPECT_EQ(lesson.tick.back(), n - 1) << "the newest rows stay";
  EXPECT_EQ(lesson.tick.front() + lesson.rows(), n);
  EXPECT_EQ(lesson.seats[7].x.size(), lesson.rows());
  EXPECT_EQ(lesson.tools[0].alpha.size(), lesson.rows());
}

}  // namespace
}  // namespace tandem::console
