// When a session is over because nobody is there any more, and how that is told.
#include "server/app/attendance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "proto/scene_text.h"
#include "proto/scenes_embedded.h"
#include "server/app/session_ending.h"
#include "server/audit.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// A lesson in which instructor and trainee sit.
struct Running {
  Running() {
    status.state = wire::SessionState::kRunning;
    for (std::size_t i = 0; i < 2; ++i) status.seats[i].taken = status.seats[i].ever_taken = status.seats[i].alive = true;
    static_cast<void>(attendance.look(now, status, scene));
  }
  void leave(std::size_t seat) { status.seats[seat].taken = status.seats[seat].alive = false; }
  void fall_silent(std::size_t seat) { status.seats[seat].alive = false; }
  Attendance::News after(Duration time) {
    static_cast<void>(attendance.look(now, status, scene));
    now += time;
    return attendance.look(now, status, scene);
  }

  SceneSpec scene = *parse_scene(find_shipped_scene("lesson")->text, "lesson.textproto");
  Time now = Time{} + 1s;
  SessionStatus status;
  Attendance attendance;
};

std::string texts(const Attendance::News& news) {
  std::string all;
  for (const Attendance::Note& note : news.notes) all += note.text + "\n";
  return all;
}

/// The last ten seconds of a session without an end are announced when they begin, once, and anew after somebody came back.
TEST(Attendance, AnnouncesTheEndOfALessonThatEverybodyLeft) {
  const std::string wanted = "everybody left: the session ends in 10 s, unless somebody joins it again\n";
  Running lesson;
  lesson.leave(0);
  EXPECT_EQ(texts(lesson.attendance.look(lesson.now, lesson.status, lesson.scene)), "instructor left\n") << "one is still there";
  lesson.leave(1);
  EXPECT_EQ(texts(lesson.attendance.look(lesson.now, lesson.status, lesson.scene)), "trainee left\n" + wanted);
  EXPECT_EQ(texts(lesson.after(5s)), "") << "once";
  lesson.status.seats[0].taken = lesson.status.seats[0].alive = true;
  EXPECT_EQ(texts(lesson.attendance.look(lesson.now, lesson.status, lesson.scene)), "instructor joined\n") << "somebody is there again";
  lesson.leave(0);
  EXPECT_EQ(texts(lesson.attendance.look(lesson.now, lesson.status, lesson.scene)), "instructor left\n" + wanted);

  EXPECT_EQ(texts(lesson.after(11s)), "") << "that each of them is gone needs no warning more";

  Running with_end;
  with_end.scene.duration = 60;
  with_end.leave(0);
  with_end.leave(1);
  EXPECT_EQ(texts(with_end.after(1s)).find("ends in"), std::string::npos) << "it waits for them until its end";
  Running lost;
  lost.leave(0);
  lost.fall_silent(1);
  EXPECT_EQ(texts(lost.after(1s)).find("ends in"), std::string::npos) << "the trainee did not leave";
}

/// Of a console the house tells who stopped, and why: here follows only what that means.
TEST(Attendance, AStopFromAConsoleIsNotToldTwice) {
  Running lesson;
  lesson.status.state = wire::SessionState::kStopped;
  static_cast<void>(lesson.status.stop.press(lesson.now, AccessRole::kOperator, AuditEvent::kControlPlane));
  const std::string told = texts(lesson.attendance.look(lesson.now, lesson.status, lesson.scene));
  EXPECT_EQ(told.find("all hands are let go; who may end it: "), 0u) << told;
  Running seat;
  seat.status.state = wire::SessionState::kStopped;
  static_cast<void>(seat.status.stop.press(seat.now, AccessRole::kInstructor, 0));
  EXPECT_EQ(texts(seat.attendance.look(seat.now, seat.status, seat.scene)).find("STOPPED by instructor: all hands are let go"), 0u);
}

TEST(Attendance, KnowsWhoLeftFromWhoWasLost) {
  Running left;
  left.leave(0);
  EXPECT_FALSE(left.after(11s).all_lost) << "one is still there";
  left.leave(1);
  EXPECT_FALSE(left.after(9s).all_left);
  const Attendance::News both = left.after(2s);
  EXPECT_TRUE(both.all_left) << "a session without an end is over, and well";
  EXPECT_FALSE(both.all_lost) << "a scene with an end waits for them for 60 s";
  EXPECT_TRUE(left.after(50s).all_lost);

  Running lost;
  lost.leave(0);
  lost.fall_silent(1);
  EXPECT_FALSE(lost.after(59s).all_lost) << "clients try for as long to come back";
  const Attendance::News one = lost.after(2s);
  EXPECT_TRUE(one.all_lost);
  EXPECT_FALSE(one.all_left) << "the trainee did not leave: its link or program failed";
}

bool says(const Attendance::News& news, const std::string& event, const std::string& seat) {
  return std::ranges::any_of(news.notes, [&](const Attendance::Note& n) { return n.event == event && n.seat == seat; });
}

TEST(Attendance, WarnsOfASeatThatFellSilentAndNotOfOneThatLeft) {
  Running s;
  s.leave(0);
  s.fall_silent(1);
  const Attendance::News news = s.after(11s);
  EXPECT_FALSE(says(news, "gone", s.scene.seats[0].name)) << "its person left, and that was told";
  EXPECT_TRUE(says(news, "gone", s.scene.seats[1].name));
}

TEST(Attendance, OfAnEndlessSessionThatAllLeaveHasNoWarning) {
  Running s;
  s.leave(0);
  s.leave(1);
  for (const Attendance::Note& note : s.after(11s).notes) EXPECT_FALSE(note.warning) << note.text;
}

/// A stop hides that a session still waits: who is away then is waited for, as without the stop.
TEST(Attendance, CountsASessionThatIsStoppedWhileItWaitsAsWaiting) {
  Running s;
  s.status.state = wire::SessionState::kStopped;
  s.status.waits = true;
  s.fall_silent(0);
  s.leave(1);
  const Attendance::News news = s.after(61s);
  EXPECT_FALSE(news.all_lost) << "else it ends as peers_lost while people have 10 min to come back";
  EXPECT_FALSE(says(news, "gone", s.scene.seats[0].name));
  s.leave(0);
  EXPECT_FALSE(s.after(61s).all_left);
  s.status.waits = false;
  EXPECT_TRUE(s.after(61s).all_left) << "a session that began and was stopped";
}

/// A restored session whose people have 10 min to come back.
struct Restored : Running {
  Restored() {
    for (std::size_t i = 0; i < 2; ++i) status.seats[i] = {};
    status.state = wire::SessionState::kWaiting;
    when.back_until = now + 10min;
  }
  std::optional<SessionEnding> after_restart(Duration time) {
    when.now = now + time;
    return session_ending(when, {}, status, scene);
  }
  SessionEnding::When when;
};

TEST(SessionEnding, OfARestoredSessionToWhichNobodyCameBackComesWhenTheTimeIsOver) {
  Restored s;
  EXPECT_FALSE(s.after_restart(10min)) << "until then they may come";
  const auto over = s.after_restart(10min + 1s);
  ASSERT_TRUE(over);
  EXPECT_EQ(over->why, End::kNobodyCame);
  EXPECT_TRUE(over->note.warning);
  s.when.back_until.reset();
  EXPECT_FALSE(s.after_restart(11min)) << "a new session waits as long as people like";
}

TEST(SessionEnding, OfARestoredSessionDoesNotComeWhileSomebodyIsThere) {
  Restored s;
  s.status.seats[1].taken = s.status.seats[1].ever_taken = true;
  EXPECT_FALSE(s.after_restart(11min)) << "it waits for the others";
  s.leave(1);
  EXPECT_TRUE(s.after_restart(11min)) << "who came has left, and the session still waits";
  s.status.state = wire::SessionState::kRunning;
  EXPECT_FALSE(s.after_restart(11min)) << "it went on, and ends as every session does";
}

TEST(SessionEnding, OfARestoredSessionThatIsStoppedComesIfNobodyEverCame) {
  Restored s;
  s.status.state = wire::SessionState::kStopped;
  EXPECT_TRUE(s.after_restart(11min));
  s.status.seats[0].ever_taken = true;
  EXPECT_FALSE(s.after_restart(11min));
}

TEST(SessionEnding, OfARestoredSessionThatIsStoppedWhileItGathersComesWhenThoseWhoCameLeft) {
  Restored s;
  s.status.state = wire::SessionState::kStopped;
  s.status.waits = true;
  s.status.seats[0].taken = s.status.seats[0].ever_taken = true;
  EXPECT_FALSE(s.after_restart(11min));
  s.leave(0);
  EXPECT_TRUE(s.after_restart(11min));
}

TEST(SessionEnding, IsOneAtATimeAndNamesItsReason) {
  Restored s;
  s.when = {.now = s.now, .began = s.now, .wait_s = 5};
  EXPECT_FALSE(session_ending(s.when, {}, s.status, s.scene));
  s.when.now = s.now + 6s;
  ASSERT_TRUE(session_ending(s.when, {}, s.status, s.scene));
  EXPECT_EQ(session_ending(s.when, {}, s.status, s.scene)->why, End::kNobodyCame);
  EXPECT_EQ(session_ending(s.when, {.notes = {}, .all_lost = true}, s.status, s.scene)->why, End::kPeersLost);
  EXPECT_EQ(session_ending(s.when, {.notes = {}, .all_lost = true, .all_left = true}, s.status, s.scene)->why, End::kPeopleLeft);
  s.scene.duration = 60;
  EXPECT_EQ(session_ending(s.when, {.notes = {}, .all_lost = true, .all_left = true}, s.status, s.scene)->why, End::kPeersLost) << "a scene with an end waits for its people";
}

}  // namespace
}  // namespace tandem::server
