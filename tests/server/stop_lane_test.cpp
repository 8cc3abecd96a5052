// Who may end a stop, and what people read of it: the lane alone, press by press.
#include "server/stop_lane.h"

#include <gtest/gtest.h>

#include "server/audit_words.h"
#include "server/stop_words.h"
#include "tests/support/world_run.h"

namespace tandem::server {
namespace {

using Level = StopLane::Level;
using Resume = StopLane::Resume;

constexpr std::uint32_t kAll = ~0U;
constexpr std::uint8_t kConsole = AuditEvent::kControlPlane;

TEST(StopLane, WhereNobodyLeadsWhoPausedTakesHisOwnPauseBack) {
  StopLane lane{false};
  ASSERT_EQ(lane.press(Time{}, AccessRole::kTrainee, 0), Level::kPaused);
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 1, kAll), Resume::kOthers) << "the trainee's is still on";
  EXPECT_EQ(lane.level(), Level::kPaused);
  EXPECT_EQ(lane.resume(AccessRole::kObserver, 2, 1, kAll), Resume::kForbidden);
  EXPECT_EQ(lane.resume(AccessRole::kRecorder, StopLane::kNobody, 1, kAll), Resume::kForbidden);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 0, kAll), Resume::kOutdated);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 1, kAll), Resume::kEnded);
  EXPECT_FALSE(lane.on());
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 1, kAll), Resume::kOutdated);
}

TEST(StopLane, OfTwoWhoPausedNeitherEndsTheOthers) {
  StopLane lane{false};
  static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
  static_cast<void>(lane.press(Time{}, AccessRole::kEvaluator, 1));
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 2, kAll), Resume::kOthers);
  EXPECT_EQ(lane.holders(kAll), 1U);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 2, kAll), Resume::kEnded);
  // Who is not there any more holds nobody up: silent, or his seat is somebody else's.
  static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 3, 0b10), Resume::kEnded);
  static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
  lane.forget(0);
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 4, kAll), Resume::kEnded);
}

TEST(StopLane, WhatAnOperatorStoppedOrAnInstructorCouldEndIsNotTheirs) {
  for (const bool led : {false, true}) {
    StopLane lane{led};
    static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
    static_cast<void>(lane.press(Time{}, AccessRole::kOperator, kConsole, Level::kPaused));
    EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 2, kAll), Resume::kForbidden) << "an operator paused too";
    EXPECT_EQ(lane.resume(AccessRole::kOperator, StopLane::kNobody, 2, kAll), Resume::kEnded);
    static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
    EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 3, kAll), led ? Resume::kForbidden : Resume::kEnded);
  }
  StopLane lane{false};
  static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
  lane.raise(Level::kStopped, {Level::kStopped, StopLane::kNobody, AccessRole::kObserver, Time{}});
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 2, kAll), Resume::kForbidden) << "the session itself stopped";
  EXPECT_EQ(lane.resume(AccessRole::kInstructor, StopLane::kNobody, 2, kAll), Resume::kEnded) << "an instructor at a console";
}

TEST(StopLane, APauseFromBeforeARestartIsInheritedByAllWhoMayPause) {
  StopLane lane{false};
  lane.restore(Level::kPaused, 4);
  EXPECT_EQ(lane.resume(AccessRole::kObserver, 2, 4, kAll), Resume::kForbidden);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 4, kAll), Resume::kEnded);
  lane.restore(Level::kStopped, 5);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 5, kAll), Resume::kForbidden);
}

TEST(StopWords, SayWhoMayEndItAndHow) {
  SceneSpec scene = test::shipped("eight_seats");
  ASSERT_FALSE(scene.led());
  ASSERT_TRUE(test::shipped("free_motion").led());
  StopLane lane{scene.led()}, led{true};
  EXPECT_EQ(who_ends(lane, scene, kAll), "");
  EXPECT_FALSE(newest_stop(lane, scene, 0, kAll));
  static_cast<void>(lane.press(Time{}, AccessRole::kTrainee, 0));
  EXPECT_EQ(who_ends(lane, scene, kAll), "trainee (key r), who paused, or an operator (`tandem-client control resume`)");
  EXPECT_TRUE(lane.awaits(AccessRole::kTrainee, 0, kAll));
  EXPECT_FALSE(lane.awaits(AccessRole::kEvaluator, 2, kAll)) << "who paused nothing is not told that he may";
  EXPECT_TRUE(lane.awaits(AccessRole::kEvaluator, 2, 1U << 2)) << "nobody else is there any more";
  EXPECT_TRUE(lane.awaits(AccessRole::kOperator, StopLane::kNobody, kAll));
  EXPECT_NE(who_ends(lane, scene, 0).find("anybody at a seat who may pause (key r)"), std::string::npos);
  static_cast<void>(lane.press(Time{}, AccessRole::kEvaluator, 2));
  EXPECT_EQ(who_ends(lane, scene, kAll), "trainee and evaluator2 (key r each), who paused, or an operator (`tandem-client control resume`)");
  const auto stop = newest_stop(lane, scene, 1.5, kAll);
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->number, 2U);
  EXPECT_EQ(stop->seat, "evaluator2");
  EXPECT_EQ(stop->role, AccessRole::kEvaluator);
  EXPECT_EQ(stop->kind, tandem::control::StopKind::kPause);
  static_cast<void>(lane.press(Time{}, AccessRole::kOperator, kConsole));
  EXPECT_EQ(who_ends(lane, scene, kAll), "an operator (`tandem-client control resume`)");
  EXPECT_EQ(newest_stop(lane, scene, 0, kAll)->seat, "");
  static_cast<void>(led.press(Time{}, AccessRole::kTrainee, 1));
  EXPECT_EQ(who_ends(led, test::shipped("free_motion"), kAll), "an instructor (key r) or an operator (`tandem-client control resume`)");
}

TEST(AuditWords, NameTheToolAndEverySeatOfAChangeOfAuthority) {
  const SceneSpec scene = test::shipped("free_motion");
  AuditEvent e;
  e.what = AuditEvent::What::kAuthority;
  e.seat = AuditEvent::kTimeline;
  e.masters = 2;
  e.version = 3;
  e.tick = 500;
  e.before = {1, 0};
  e.after = {0.25, 0.75};
  EXPECT_EQ(audit_words(e, scene), "timeline tool version 3 tick 500: trainer 1.000 to 0.250, trainee 0.000 to 0.750");
  e = {};
  e.seat = 1;
  e.tick = 7;
  EXPECT_EQ(audit_words(e, scene), "trainee tick 7");
}

}  // namespace
}  // namespace tandem::server
