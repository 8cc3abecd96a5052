// Texts of the tutorial for any sequence and timing of keys.
#include "client/app/tutorial.h"

#include <gtest/gtest.h>

#include <tuple>

namespace tandem::client {
namespace {

/// An instructor's seat in a session with a simulated trainee.
struct Lesson {
  Lesson() {
    setup.seat.name = "instructor";
    setup.seat.role = Role::kInstructor;
    setup.masters = {"instructor", "trainee"};
    setup.driver_mask = 3;
    guidance.emplace(setup, true, std::vector<std::string>{"trainee"});
    status.session = wire::SessionState::kRunning;
    status.session_time = 0;
    status.alpha = 1;
  }
  /// Returns all messages until `until_s` [s].
  std::string until(double until_s) {
    std::string text;
    for (; now_s <= until_s; now_s += 0.1)
      for (const std::string& line : guidance->messages(now_s, status)) text += line + "\n";
    return text;
  }
  SeatSetup setup;
  ClientStatus status;
  std::optional<Tutorial> guidance;
  double now_s = 0;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Tutorial, AsksForEachKeyAndReportsItsEffect) {
  Lesson l;
  EXPECT_TRUE(has(l.until(6), "2/6  press the arrow keys"));
  EXPECT_TRUE(has(l.until(8), "3/6  press 0: trainee gets the tool"));
  l.guidance->on_key("0");
  EXPECT_TRUE(has(l.until(11), "trainee has the tool now"));
}

TEST(Tutorial, CountsAKeyPressedBeforeItsStep) {
  Lesson l;
  static_cast<void>(l.until(2));
  l.guidance->on_key("0");
  const std::string soon = l.until(5);
  EXPECT_TRUE(has(soon, "trainee has the tool now")) << soon;
  const std::string step = l.until(8);
  EXPECT_TRUE(has(step, "3/6  0 gives the tool to the partner: you have done that already")) << step;
  EXPECT_FALSE(has(step, "press 0")) << step;
  l.guidance->on_key("0");
  EXPECT_FALSE(has(l.until(11), "trainee has the tool now")) << "the message appears once";
}

TEST(Tutorial, ReportsNoTakeBackWithoutATransferBefore) {
  Lesson l;
  static_cast<void>(l.until(2));
  l.guidance->on_key("1");  // this seat already has all authority
  EXPECT_FALSE(has(l.until(5), "you have the tool again"));
  EXPECT_TRUE(has(l.until(13), "press 1: you take the tool back")) << "it is still to be tried";
}

TEST(Tutorial, DistinguishesTheSmallSFromTheCapitalS) {
  Lesson small, capital;
  const std::string asked = small.until(17);
  EXPECT_TRUE(has(asked, "press s (small): only your own hand is released")) << asked;
  EXPECT_TRUE(has(asked, "Capital S stops all hands")) << asked;
  small.guidance->on_key("s");
  EXPECT_TRUE(has(small.until(19), "only your hand is stopped; press r to resume"));
  static_cast<void>(capital.until(17));
  capital.guidance->on_key("S");
  EXPECT_TRUE(has(capital.until(19), "capital S stopped all hands; press r to resume"));
}

/// Key r of a trainee ends no pause of a session with an instructor.
TEST(Tutorial, PromisesAResumeOnlyToSeatsThatMayResume) {
  for (const auto& [role, ends_pauses, may] :
       {std::tuple{Role::kInstructor, false, true}, std::tuple{Role::kTrainee, false, false},
        std::tuple{Role::kTrainee, true, true}, std::tuple{Role::kEvaluator, false, false}}) {
    SCOPED_TRACE(static_cast<int>(role));
    Lesson l;
    l.setup.seat.role = role;
    l.setup.may_end_pauses = ends_pauses;
    static_cast<void>(l.until(6));
    l.guidance->on_key("S");
    l.status.session = wire::SessionState::kPaused;
    const std::string text = l.until(13);
    EXPECT_EQ(has(text, "capital S stopped all hands; press r to resume"), may) << text;
    EXPECT_EQ(has(text, "press r first, all hands are stopped; then press 0"), may) << text;
    EXPECT_EQ(has(text, "capital S stopped all hands; an instructor or operator resumes, not this seat"), !may) << text;
    EXPECT_EQ(has(text, "once an instructor or operator has resumed: press 0"), !may) << text;
  }
}

TEST(Tutorial, ReportsThatAKeyActsOnlyAfterAResume) {
  Lesson l;
  static_cast<void>(l.until(6));
  l.status.session = wire::SessionState::kStopped;
  EXPECT_TRUE(has(l.until(8), "3/6  press r first, all hands are stopped; then press 0: trainee gets the tool"));
  l.status.session = wire::SessionState::kRunning;
  l.status.local_stop = true;
  EXPECT_TRUE(has(l.until(13), "4/6  press r first, your hand is stopped; then press 1: you take the tool back"));
  const std::string rest = l.until(21);
  EXPECT_TRUE(has(rest, "5/6  press r first, your hand is stopped; then press s (small)")) << rest;
  EXPECT_TRUE(has(rest, "6/6  that was all")) << "nothing is to be pressed for it";
}

}  // namespace
}  // namespace tandem::client
