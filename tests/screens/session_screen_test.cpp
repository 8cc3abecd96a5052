// The server's screen of its sessions, and the reasons for a braked tool.
#include <gtest/gtest.h>

#include "common/io/terminal.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/control/control_plane.h"
#include "server/app/monitor/session_status.h"

namespace tandem::server {
namespace {

SceneSpec scene() {
  auto parsed = parse_scene(find_shipped_scene("free_motion")->text, "free_motion");
  return *parsed;
}

/// Trainer and trainee, engaged; the trainer has all authority.
SessionStatus running() {
  SessionStatus s;
  s.state = wire::SessionState::kRunning;
  s.time = 12.3;
  for (std::size_t i = 0; i < 2; ++i) {
    SeatStatus& seat = s.seats[i];
    seat.taken = seat.ever_taken = seat.ready = seat.alive = true;
    seat.gate = wire::GateState::kActive;
    seat.link.rtt_p50_ms = 4.1;
  }
  s.seats[0].alpha = s.seats[0].authority_max = 1;
  return s;
}

TEST(BrakedReason, NamesTheSeatAndTheReasonInOneSentence) {
  const SceneSpec spec = scene();
  SessionStatus s = running();
  s.seats[0].taken = false;
  EXPECT_EQ(held_reason_text(s, spec), "trainer left");
  s = running();
  s.seats[0].stopped = true;
  EXPECT_EQ(held_reason_text(s, spec), "stopped by trainer: key r there resumes");
  s = running();
  s.seats[0].alive = false;
  EXPECT_EQ(held_reason_text(s, spec), "trainer is silent: its link is lost");
  s = running();
  s.seats[0].gate = wire::GateState::kLatched;
  EXPECT_EQ(held_reason_text(s, spec), "trainer's force is latched off: key b there switches it on");
  s = running();
  s.seats[1].taken = false;
  EXPECT_EQ(held_reason_text(s, spec), "no seat with authority is engaged")
      << "a seat without authority holds nothing up";
}

TEST(SessionScreen, ShowsStateAndLeaderThenTheSeats) {
  const SceneSpec spec = scene();
  SessionStatus s = running();
  s.seats[0].alpha = 0.75;
  s.seats[1].alpha = 0.25;
  const auto lines = io::lay_out_items(status_items(s, spec), 2, 79);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("running | trainer leads 75 %, trainee 25 %"), std::string::npos) << lines[0];
  EXPECT_EQ(lines[1].find("trainer: force on"), 0u) << lines[1];
  EXPECT_NE(lines[1].find("trainee: force on"), std::string::npos) << lines[1];
}

TEST(SessionScreen, DistinguishesForceOffFromForceNotYetOn) {
  const SceneSpec spec = scene();
  SessionStatus s = running();
  s.state = wire::SessionState::kStopped;
  s.seats[0].gate = s.seats[1].gate = wire::GateState::kZero;
  EXPECT_NE(io::lay_out_items(status_items(s, spec), 2, 119)[1].find("trainer: force off"), std::string::npos);
}

/// The audit log and the metrics use one word per event; the screen shows a sentence.
TEST(Notices, DescribeControlEventsWithoutTokens) {
  for (std::size_t i = 0; i < kControlEvents; ++i) {
    const auto event = static_cast<ControlEvent>(i);
    EXPECT_EQ(control_event_text(event).find('_'), std::string::npos) << control_event_text(event);
    EXPECT_FALSE(control_event_text(event).empty());
  }
  EXPECT_EQ(control_event_text(ControlEvent::kCodeRefused), "was refused for a wrong code");
  EXPECT_EQ(control_event_text(ControlEvent::kNotEnrolled), "is not enrolled here");
  EXPECT_EQ(to_text(ControlEvent::kCodeRefused), "code_refused");
}

TEST(SessionScreen, GivesEachSessionItsLinesAndCountsThoseThatDoNotFit) {
  const SceneSpec spec = scene();
  std::vector<SessionScreenEntry> sessions;
  for (int i = 0; i < 10; ++i) sessions.push_back({"session-" + std::to_string(i), running(), &spec});
  EXPECT_EQ(io::lay_out_items(screen_items(sessions, "", 23, ""), 23, 79).size(), 20u) << "two each";
  const auto one_each = io::lay_out_items(screen_items(sessions, "", 12, ""), 12, 79);
  ASSERT_EQ(one_each.size(), 10u);
  EXPECT_EQ(one_each[9].find("session-9: "), 0u) << one_each[9];
  const auto few =
      io::lay_out_items(screen_items(sessions, "DRAINING, 5 s left", 5, "tandem-server sessions --state /s"), 5, 79);
  ASSERT_EQ(few.size(), 5u);
  EXPECT_EQ(few[0].find("DRAINING, 5 s left | session-0: "), 0u) << few[0];
  EXPECT_EQ(few[4], "and 6 sessions more: `tandem-server sessions --state /s` lists them");
}

TEST(SessionScreen, ShowsALongDurationInDigits) {
  SceneSpec spec = scene();
  spec.duration = 3e6;
  const std::vector<SessionScreenEntry> one{{"a", running(), &spec}};
  const std::string line = io::lay_out_items(screen_items(one, "", 2, ""), 2, 79)[0];
  EXPECT_NE(line.find(" of 3000000 s"), std::string::npos) << line;
}

TEST(SessionScreen, NamesTheResumeCommandOrTheRolesInAStop) {
  const SceneSpec spec = scene();
  SessionStatus s = running();
  s.state = wire::SessionState::kStopped;
  s.stop = StopLatch(spec.has_instructor());
  s.stop.raise(StopLatch::Level::kStopped, {StopLatch::Level::kStopped, 0, AccessRole::kInstructor, Time{}});
  const auto shown = [&](std::size_t width, std::vector<SessionScreenEntry> sessions) {
    return io::lay_out_items(screen_items(sessions, "", 2, ""), 2, width)[0];
  };
  const SessionScreenEntry one{"a", s, &spec, " --server 10.0.0.7:7000"};
  const std::string wide = shown(200, {one}), narrow = shown(79, {one});
  EXPECT_NE(wide.find("`tandem-client control --server 10.0.0.7:7000 resume`"), std::string::npos) << wide;
  EXPECT_NE(narrow.find("STOPPED; ends it: an instructor (key r) or an operator"), std::string::npos) << narrow;
  EXPECT_EQ(narrow.find('`'), std::string::npos) << narrow;
  const std::string two =
      shown(40, {{"a", s, &spec, " --server h:1 --session a"}, {"b", s, &spec, " --server h:1 --session b"}});
  EXPECT_NE(two.find("STOPPED"), std::string::npos) << two;
}

// A server of a service may have no session for hours; its log has no empty lines.
TEST(SessionScreen, OfNoSessionWritesNothingToALog) {
  testing::internal::CaptureStderr();
  io::StatusLine line{false};
  line.show(screen_items({}, "", 2, ""), 2);
  line.show(screen_items({}, "DRAINING, 5 s left", 2, ""), 2);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(log, "DRAINING, 5 s left\n");
}

}  // namespace
}  // namespace tandem::server
