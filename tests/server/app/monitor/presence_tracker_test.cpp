// When a session ends because its participants are absent, and the messages about it.
#include "server/app/monitor/presence_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/monitor/session_ending.h"
#include "server/report/audit_event.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// A lesson with an instructor and a trainee.
struct Running {
  Running() {
    status.state = wire::SessionState::kRunning;
    for (std::size_t i = 0; i < 2; ++i)
      status.seats[i].taken = status.seats[i].ever_taken = status.seats[i].alive = true;
    static_cast<void>(attendance.update(now, status, scene));
  }
  void leave(std::size_t seat) { status.seats[seat].taken = status.seats[seat].alive = false; }
  void fall_silent(std::size_t seat) { status.seats[seat].alive = false; }
  PresenceTracker::Events after(Duration time) {
    static_cast<void>(attendance.update(now, status, scene));
    now += time;
    return attendance.update(now, status, scene);
  }

  SceneSpec scene = *parse_scene(find_shipped_scene("lesson")->text, "lesson.textproto");
  Time now = Time{} + 1s;
  SessionStatus status;
  PresenceTracker attendance;
};

std::string texts(const PresenceTracker::Events& news) {
  std::string all;
  for (const PresenceTracker::Event& note : news.events) all += note.text + "\n";
  return all;
}

/// No control connection of this server reports its author.
TEST(PresenceTracker, NamesTheConsoleOfAStopThatAnEarlierServerTook) {
  Running lesson;
  StopLatch::Latest stop{StopLatch::Level::kStopped, AuditEvent::kControlPlane, AccessRole::kOperator};
  stop.words.workstation = FixedText<rpc::kNameMax>{"office"};
  stop.words.why = FixedText<rpc::kTextMax>{"fire drill"};
  stop.restored = true;
  lesson.status.stop.restore(StopLatch::Level::kStopped, 2, stop);
  lesson.status.state = wire::SessionState::kStopped;
  const std::string text = texts(lesson.attendance.update(lesson.now, lesson.status, lesson.scene));
  EXPECT_EQ(text.find("STOPPED by office: fire drill: all hands are released; it can be ended by: "), 0U) << text;
}

/// The last ten seconds of a session without an end are announced when they begin: once, and again after a participant
/// came back.
TEST(PresenceTracker, AnnouncesTheEndOfASessionThatAllParticipantsLeft) {
  const std::string wanted = "all participants left: the session ends in 10 s, unless a client joins it again\n";
  Running lesson;
  lesson.leave(0);
  EXPECT_EQ(texts(lesson.attendance.update(lesson.now, lesson.status, lesson.scene)), "instructor left\n")
      << "one is still there";
  lesson.leave(1);
  EXPECT_EQ(texts(lesson.attendance.update(lesson.now, lesson.status, lesson.scene)), "trainee left\n" + wanted);
  EXPECT_EQ(texts(lesson.after(5s)), "") << "once";
  lesson.status.seats[0].taken = lesson.status.seats[0].alive = true;
  EXPECT_EQ(texts(lesson.attendance.update(lesson.now, lesson.status, lesson.scene)), "instructor joined\n")
      << "a participant is present again";
  lesson.leave(0);
  EXPECT_EQ(texts(lesson.attendance.update(lesson.now, lesson.status, lesson.scene)), "instructor left\n" + wanted);

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

/// The session registry reports stops by consoles, with name and reason. Here only the consequences follow.
TEST(PresenceTracker, DoesNotRepeatStopsThatTheRegistryReports) {
  Running lesson;
  lesson.status.state = wire::SessionState::kStopped;
  static_cast<void>(lesson.status.stop.request(lesson.now, AccessRole::kOperator, AuditEvent::kControlPlane));
  const std::string told = texts(lesson.attendance.update(lesson.now, lesson.status, lesson.scene));
  EXPECT_EQ(told.find("all hands are released; it can be ended by: "), 0u) << told;
  Running seat;
  seat.status.state = wire::SessionState::kStopped;
  static_cast<void>(seat.status.stop.request(seat.now, AccessRole::kInstructor, 0));
  EXPECT_EQ(texts(seat.attendance.update(seat.now, seat.status, seat.scene))
                .find("STOPPED by instructor: all hands are released"),
            0u);
}

TEST(PresenceTracker, DistinguishesParticipantsThatLeftFromLostOnes) {
  Running left;
  left.leave(0);
  EXPECT_FALSE(left.after(11s).all_lost) << "one is still there";
  left.leave(1);
  EXPECT_FALSE(left.after(9s).all_left);
  const PresenceTracker::Events both = left.after(2s);
  EXPECT_TRUE(both.all_left) << "a session without an end is over, and well";
  EXPECT_FALSE(both.all_lost) << "a scene with an end waits for them for 60 s";
  EXPECT_TRUE(left.after(50s).all_lost);

  Running lost;
  lost.leave(0);
  lost.fall_silent(1);
  EXPECT_FALSE(lost.after(59s).all_lost) << "clients try for as long to come back";
  const PresenceTracker::Events one = lost.after(2s);
  EXPECT_TRUE(one.all_lost);
  EXPECT_FALSE(one.all_left) << "the trainee did not leave: its link or program failed";
}

bool says(const PresenceTracker::Events& news, const std::string& event, const std::string& seat) {
  return std::ranges::any_of(news.events,
                             [&](const PresenceTracker::Event& n) { return n.event == event && n.seat == seat; });
}

TEST(PresenceTracker, WarnsOfASeatThatFellSilentAndNotOfOneThatLeft) {
  Running s;
  s.leave(0);
  s.fall_silent(1);
  const PresenceTracker::Events news = s.after(11s);
  EXPECT_FALSE(says(news, "gone", s.scene.seats[0].name)) << "its participant left, which was reported";
  EXPECT_TRUE(says(news, "gone", s.scene.seats[1].name));
}

TEST(PresenceTracker, DoesNotWarnWhenAllLeaveAnEndlessSession) {
  Running s;
  s.leave(0);
  s.leave(1);
  for (const PresenceTracker::Event& note : s.after(11s).events) EXPECT_FALSE(note.warning) << note.text;
}

/// A stop hides that a session still waits: absent participants are waited for as without the stop.
TEST(PresenceTracker, CountsASessionThatIsStoppedWhileItWaitsAsWaiting) {
  Running s;
  s.status.state = wire::SessionState::kStopped;
  s.status.waiting = true;
  s.fall_silent(0);
  s.leave(1);
  const PresenceTracker::Events news = s.after(61s);
  EXPECT_FALSE(news.all_lost) << "else it ends as peers_lost while participants have 10 min to come back";
  EXPECT_FALSE(says(news, "gone", s.scene.seats[0].name));
  s.leave(0);
  EXPECT_FALSE(s.after(61s).all_left);
  s.status.waiting = false;
  EXPECT_TRUE(s.after(61s).all_left) << "a session that began and was stopped";
}

/// A restored session whose participants have 10 min to resume.
struct Restored : Running {
  Restored() {
    for (std::size_t i = 0; i < 2; ++i) status.seats[i] = {};
    status.state = wire::SessionState::kWaiting;
    when.return_until = now + 10min;
  }
  std::optional<SessionEnding> after_restart(Duration time) {
    when.now = now + time;
    return session_ending(when, {}, status, scene);
  }
  SessionEnding::Times when;
};

TEST(SessionEnding, EndsARestoredSessionWithoutParticipantsAfterTheTimeout) {
  Restored s;
  EXPECT_FALSE(s.after_restart(10min)) << "until then they may come";
  const auto over = s.after_restart(10min + 1s);
  ASSERT_TRUE(over);
  EXPECT_EQ(over->why, EndReason::kStartTimeout);
  EXPECT_TRUE(over->event.warning);
  s.when.return_until.reset();
  EXPECT_FALSE(s.after_restart(11min)) << "a new session waits for participants without a limit";
}

TEST(SessionEnding, KeepsARestoredSessionWhileAParticipantIsConnected) {
  Restored s;
  s.status.seats[1].taken = s.status.seats[1].ever_taken = true;
  EXPECT_FALSE(s.after_restart(11min)) << "it waits for the others";
  s.leave(1);
  EXPECT_TRUE(s.after_restart(11min)) << "the only participant has left, and the session still waits";
  s.status.state = wire::SessionState::kRunning;
  EXPECT_FALSE(s.after_restart(11min)) << "it went on, and ends as every session does";
}

TEST(SessionEnding, EndsAStoppedRestoredSessionThatNoClientJoined) {
  Restored s;
  s.status.state = wire::SessionState::kStopped;
  EXPECT_TRUE(s.after_restart(11min));
  s.status.seats[0].ever_taken = true;
  EXPECT_FALSE(s.after_restart(11min));
}

TEST(SessionEnding, EndsAStoppedRecoveringSessionAfterItsParticipantsLeft) {
  Restored s;
  s.status.state = wire::SessionState::kStopped;
  s.status.waiting = true;
  s.status.seats[0].taken = s.status.seats[0].ever_taken = true;
  EXPECT_FALSE(s.after_restart(11min));
  s.leave(0);
  EXPECT_TRUE(s.after_restart(11min));
}

TEST(SessionEnding, ReturnsOneReasonAtATime) {
  Restored s;
  s.when = {.now = s.now, .began = s.now, .start_timeout_s = 5};
  EXPECT_FALSE(session_ending(s.when, {}, s.status, s.scene));
  s.when.now = s.now + 6s;
  ASSERT_TRUE(session_ending(s.when, {}, s.status, s.scene));
  EXPECT_EQ(session_ending(s.when, {}, s.status, s.scene)->why, EndReason::kStartTimeout);
  EXPECT_EQ(session_ending(s.when, {.events = {}, .all_lost = true}, s.status, s.scene)->why, EndReason::kPeersLost);
  EXPECT_EQ(session_ending(s.when, {.events = {}, .all_lost = true, .all_left = true}, s.status, s.scene)->why,
            EndReason::kAllLeft);
  s.scene.duration = 60;
  EXPECT_EQ(session_ending(s.when, {.events = {}, .all_lost = true, .all_left = true}, s.status, s.scene)->why,
            EndReason::kPeersLost)
      << "a scene with an end waits for its participants";
}

}  // namespace
}  // namespace tandem::server
