// Rules for ending a stop, and the messages about it: the stop latch alone, request by request.
#include "server/session/stop_latch.h"

#include <gtest/gtest.h>

#include "server/report/audit_text.h"
#include "server/session/stop_text.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

using Level = StopLatch::Level;
using Result = CommandResult;

constexpr std::uint32_t kAll = ~0U;
constexpr std::uint8_t kConsole = AuditEvent::kControlPlane;

TEST(StopLatch, LetsASeatEndItsOwnPauseWithoutAnInstructor) {
  StopLatch lane{false};
  ASSERT_EQ(lane.request(Time{}, AccessRole::kTrainee, 0), Level::kPaused);
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 1, kAll), Result::kHeldByOthers) << "the trainee's is still on";
  EXPECT_EQ(lane.level(), Level::kPaused);
  EXPECT_EQ(lane.resume(AccessRole::kObserver, 2, 1, kAll), Result::kForbidden);
  EXPECT_EQ(lane.resume(AccessRole::kRecorder, StopLatch::kNoSeat, 1, kAll), Result::kForbidden);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 0, kAll), Result::kOutdated);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 1, kAll), Result::kDone);
  EXPECT_FALSE(lane.latched());
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 1, kAll), Result::kOutdated);
}

TEST(StopLatch, DoesNotLetASeatEndAnotherSeatsPause) {
  StopLatch lane{false};
  static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
  static_cast<void>(lane.request(Time{}, AccessRole::kEvaluator, 1));
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 2, kAll), Result::kHeldByOthers);
  EXPECT_EQ(lane.holders(kAll), 1U);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 2, kAll), Result::kDone);
  // Participants who are not connected hold no pause: their client is silent, or another client has the seat.
  static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 3, 0b10), Result::kDone);
  static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
  lane.clear_seat(0);
  EXPECT_EQ(lane.resume(AccessRole::kEvaluator, 1, 4, kAll), Result::kDone);
}

TEST(StopLatch, LetsATraineeEndNoOperatorsStopNorAPauseWithAnInstructor) {
  for (const bool led : {false, true}) {
    StopLatch lane{led};
    static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
    static_cast<void>(lane.request(Time{}, AccessRole::kOperator, kConsole, Level::kPaused));
    EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 2, kAll), Result::kForbidden) << "an operator paused too";
    EXPECT_EQ(lane.resume(AccessRole::kOperator, StopLatch::kNoSeat, 2, kAll), Result::kDone);
    static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
    EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 3, kAll), led ? Result::kForbidden : Result::kDone);
  }
  StopLatch lane{false};
  static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
  lane.raise(Level::kStopped, {Level::kStopped, StopLatch::kNoSeat, AccessRole::kObserver, Time{}});
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 2, kAll), Result::kForbidden) << "the session itself stopped";
  EXPECT_EQ(lane.resume(AccessRole::kInstructor, StopLatch::kNoSeat, 2, kAll), Result::kDone)
      << "an instructor at a console";
}

TEST(StopLatch, LetsEveryPausingRoleEndAPauseFromBeforeARestart) {
  StopLatch lane{false};
  lane.restore(Level::kPaused, 4, {});
  EXPECT_EQ(lane.resume(AccessRole::kObserver, 2, 4, kAll), Result::kForbidden);
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 4, kAll), Result::kDone);
  lane.restore(Level::kStopped, 5, {});
  EXPECT_EQ(lane.resume(AccessRole::kTrainee, 0, 5, kAll), Result::kForbidden);
}

TEST(StopText, NamesTheRolesThatMayEndAStopAndTheCommand) {
  SceneSpec scene = test::shipped("eight_seats");
  ASSERT_FALSE(scene.has_instructor());
  ASSERT_TRUE(test::shipped("free_motion").has_instructor());
  StopLatch lane{scene.has_instructor()}, led{true};
  EXPECT_EQ(may_end_text(lane, scene, kAll), "");
  EXPECT_FALSE(latest_stop(lane, scene, 0, kAll));
  static_cast<void>(lane.request(Time{}, AccessRole::kTrainee, 0));
  EXPECT_EQ(may_end_text(lane, scene, kAll),
            "trainee (key r), which paused, or an operator (`tandem-client control resume`)");
  EXPECT_TRUE(lane.may_be_ended_by(AccessRole::kTrainee, 0, kAll));
  EXPECT_FALSE(lane.may_be_ended_by(AccessRole::kEvaluator, 2, kAll)) << "a seat that paused nothing may not end it";
  EXPECT_TRUE(lane.may_be_ended_by(AccessRole::kEvaluator, 2, 1U << 2)) << "no other seat is connected";
  EXPECT_TRUE(lane.may_be_ended_by(AccessRole::kOperator, StopLatch::kNoSeat, kAll));
  EXPECT_NE(may_end_text(lane, scene, 0).find("any seat that may pause (key r)"), std::string::npos);
  static_cast<void>(lane.request(Time{}, AccessRole::kEvaluator, 2));
  EXPECT_EQ(may_end_text(lane, scene, kAll),
            "trainee and evaluator2 (key r each), which paused, or an operator (`tandem-client control resume`)");
  const auto stop = latest_stop(lane, scene, 1.5, kAll);
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->number, 2U);
  EXPECT_EQ(stop->seat, "evaluator2");
  EXPECT_EQ(stop->role, AccessRole::kEvaluator);
  EXPECT_EQ(stop->kind, tandem::rpc::StopKind::kPause);
  static_cast<void>(lane.request(Time{}, AccessRole::kOperator, kConsole));
  EXPECT_EQ(may_end_text(lane, scene, kAll), "an operator (`tandem-client control resume`)");
  EXPECT_EQ(latest_stop(lane, scene, 0, kAll)->seat, "");
  static_cast<void>(led.request(Time{}, AccessRole::kTrainee, 1));
  EXPECT_EQ(may_end_text(led, test::shipped("free_motion"), kAll),
            "an instructor (key r) or an operator (`tandem-client control resume`)");
}

/// As of a snapshot of a release that does not keep the author.
TEST(StopText, ClaimsNothingOfAStopWithoutAnAuthor) {
  const SceneSpec scene = test::shipped("eight_seats");
  StopLatch latch{false};
  latch.restore(Level::kPaused, 3, {});
  const auto stop = latest_stop(latch, scene, 0, kAll);
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->kind, tandem::rpc::StopKind::kPause);
  EXPECT_EQ(stop->seat + stop->workstation + stop->person, "");
  EXPECT_EQ(stop->why, "it is older than this run of the session, and its author was not stored");
  EXPECT_EQ(stop->ends, "any seat that may pause (key r) or an operator (`tandem-client control resume`)");
}

TEST(AuditText, NamesTheToolAndEverySeatOfAnAuthorityChange) {
  const SceneSpec scene = test::shipped("free_motion");
  AuditEvent e;
  e.what = AuditEvent::What::kAuthority;
  e.seat = AuditEvent::kTimeline;
  e.masters = 2;
  e.version = 3;
  e.tick = 500;
  e.before = {1, 0};
  e.after = {0.25, 0.75};
  EXPECT_EQ(audit_text(e, scene), "timeline tool version 3 tick 500: trainer 1.000 to 0.250, trainee 0.000 to 0.750");
  e = {};
  e.seat = 1;
  e.tick = 7;
  EXPECT_EQ(audit_text(e, scene), "trainee tick 7");
}

}  // namespace
}  // namespace tandem::server
