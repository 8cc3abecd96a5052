// A recorded lesson as a live session.
#include "server/app/recording/replayed_lesson.h"

#include <gtest/gtest.h>

#include <cmath>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::server {
namespace {

Lesson lesson_of(const std::string& scene) {
  Lesson lesson;
  lesson.scene = *parse_scene(find_shipped_scene(scene)->text, scene + ".textproto");
  lesson.seats.resize(lesson.scene.seats.size());
  for (std::uint32_t k = 0; k < 4; ++k) {
    lesson.tick.push_back(1000 + k);
    for (LessonSeat& seat : lesson.seats) {
      seat.x.push_back({0.001 * k, 0.02, -0.03});
      seat.f.push_back({0, 0, 0});
      seat.sample_tick.push_back(1000 + k);
      seat.engaged.push_back(&seat == lesson.seats.data() ? 1 : 0);
    }
  }
  return lesson;
}

TEST(ReplayedLesson, PlaysEngagedHandsAndFreesTheOtherSeats) {
  Lesson lesson = lesson_of("free_motion");
  lesson.seats[0].x[1] = {std::nan(""), 0, 0};
  lesson.seats[0].sample_tick[3] = 1002;  // the sample before again
  const auto replayed = replayed_lesson(lesson, {}, true);
  ASSERT_TRUE(replayed) << replayed.error();
  ASSERT_EQ(replayed->hands.size(), 1u);
  EXPECT_EQ(replayed->hands[0].seat, "trainer");
  EXPECT_EQ(replayed->hands[0].csv, "t_s[s],px[m],py[m],pz[m]\n1.000000,0,0.02,-0.03\n1.002000,0.002,0.02,-0.03\n");
  EXPECT_TRUE(replayed->scene.seats[0].required);
  EXPECT_FALSE(replayed->scene.seats[1].required);
  EXPECT_DOUBLE_EQ(replayed->scene.duration, 1.003);
}

TEST(ReplayedLesson, AwaitsTheOtherRequiredSeatsWhenSeatsAreChosen) {
  Lesson lesson = lesson_of("lesson");
  const std::vector<std::string> one{"instructor"};
  for (LessonSeat& seat : lesson.seats) seat.engaged.assign(4, 1);
  const auto replayed = replayed_lesson(lesson, one, true);
  ASSERT_TRUE(replayed) << replayed.error();
  EXPECT_EQ(replayed->awaited, std::vector<std::string>(1, "trainee")) << "evaluators are optional in the scene";
  for (const SeatSpec& seat : replayed->scene.seats)
    EXPECT_EQ(seat.required, seat.name == "instructor" || seat.name == "trainee") << seat.name;
  const auto alone = replayed_lesson(lesson, one, false);
  ASSERT_TRUE(alone) << alone.error();
  EXPECT_TRUE(alone->awaited.empty());
  EXPECT_FALSE(alone->scene.seats[1].required);
}

// A hand of 1000 N/m that is pushed by 2 N has its rest position 2 mm before the force.
TEST(ReplayedLesson, MovesTheRestPositionAgainstTheForceOnTheHand) {
  Lesson lesson = lesson_of("free_motion");
  for (LessonTriple& f : lesson.seats[0].f) f = {2, 0, -1};
  lesson.seats[0].f[1] = {std::nan(""), 0, 0};
  auto replayed = replayed_lesson(lesson, {}, true);
  ASSERT_TRUE(replayed) << replayed.error();
  EXPECT_EQ(
      replayed->hands[0].csv,
      "t_s[s],px[m],py[m],pz[m]\n1.000000,-0.002,0.02,-0.029\n1.002000,0,0.02,-0.029\n1.003000,0.001,0.02,-0.029\n");
  // With a motion scale of 2, 2 N at the tool are 4 N at the hand.
  lesson.scene.seats[0].motion_scale = 2;
  replayed = replayed_lesson(lesson, {}, true);
  ASSERT_TRUE(replayed) << replayed.error();
  EXPECT_NE(replayed->hands[0].csv.find("\n1.002000,-0.003,0.01,-0.013\n"), std::string::npos)
      << replayed->hands[0].csv;
}

TEST(ReplayedLesson, DividesByTheMotionScaleOfASeat) {
  Lesson lesson = lesson_of("free_motion");
  lesson.scene.seats[0].motion_scale = 2;
  const auto replayed = replayed_lesson(lesson, {"trainer"}, true);
  ASSERT_TRUE(replayed) << replayed.error();
  EXPECT_NE(replayed->hands[0].csv.find("1.003000,0.0015,0.01,-0.015\n"), std::string::npos) << replayed->hands[0].csv;
}

TEST(ReplayedLesson, SaysHowLongTheHandsOfALateRecordingStand) {
  Lesson lesson = lesson_of("free_motion");
  lesson.scene.tick_hz = 1000;
  lesson.tick = {1, 2, 3};
  EXPECT_EQ(late_begin_text(lesson), "");
  lesson.tick = {600'000, 601'000, 660'000};
  EXPECT_EQ(late_begin_text(lesson),
            "the recording begins at 600.0 s of its session, and has nothing before: the recorded hands stand still "
            "for so long, then they move until 660.0 s");
}

TEST(ReplayedLesson, NamesWhatCannotBePlayed) {
  const Lesson lesson = lesson_of("free_motion");
  EXPECT_NE(replayed_lesson(lesson, {"nurse"}, true).error().find("master seats: trainer, trainee"), std::string::npos);
  Lesson still = lesson_of("free_motion");
  for (LessonTriple& x : still.seats[1].x) x.fill(std::nan(""));
  EXPECT_NE(replayed_lesson(still, {"trainee"}, true).error().find("no motion"), std::string::npos);
  still.seats[0].engaged.assign(4, 0);
  EXPECT_NE(replayed_lesson(still, {}, true).error().find("--seat"), std::string::npos);
  Lesson empty = lesson_of("free_motion");
  empty.tick.clear();
  EXPECT_FALSE(replayed_lesson(empty, {}, true));
  EXPECT_NE(replayed_lesson(lesson_of("contact_remote"), {}, true).error().find("SLAVE seat"), std::string::npos);
}

}  // namespace
}  // namespace tandem::server
