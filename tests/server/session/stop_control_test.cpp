// One path for stop, pause and resume, whichever connection asks. StopLatch's own rules: stop_latch_test.cpp.
#include "server/session/stop_control.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using test::SessionParts;
using Level = StopLatch::Level;
using Result = CommandResult;
using What = AuditEvent::What;

constexpr Time kNow{};
constexpr Requester kInstructorSeat = requester_at(0, AccessRole::kInstructor),
                    kTraineeSeat = requester_at(1, AccessRole::kTrainee), kOperator{AccessRole::kOperator},
                    kObserver{AccessRole::kObserver};

struct Stoppable : SessionParts {
  explicit Stoppable(const std::string& scene_name = "free_motion") : SessionParts(scene_name) {}
  /// The only event since the last call.
  AuditEvent event() {
    const auto all = events();
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? AuditEvent{} : all.back();
  }
  Participants participants{seats, clock, audit};
  StartCondition start{scene, seats, present, clock};
  StopControl stop{scene, participants, start, audit};
};

TEST(StopControl, RecordsTheSeatInTheLatchAndTheConnectionInTheEvent) {
  Stoppable s;
  EXPECT_EQ(s.stop.request(kNow, kInstructorSeat), Level::kStopped);
  AuditEvent e = s.event();
  EXPECT_TRUE(e.what == What::kStop && e.seat == 0 && e.version == 1);
  EXPECT_EQ(s.stop.latch().latest().by, 0);

  EXPECT_EQ(s.stop.request(kNow, {AccessRole::kInstructor, 0}), Level::kStopped) << "the same seat, by its console";
  e = s.event();
  EXPECT_TRUE(e.what == What::kStop && e.seat == AuditEvent::kControlPlane && e.version == 2);
  EXPECT_EQ(s.stop.latch().latest().by, 0);

  EXPECT_EQ(s.stop.request(kNow, kOperator, Level::kPaused), Level::kPaused);
  EXPECT_EQ(s.event().what, What::kPause);
  EXPECT_EQ(s.stop.latch().latest().by, AuditEvent::kControlPlane) << "a console has no seat";
  EXPECT_EQ(s.stop.latch().level(), Level::kStopped) << "a pause weakens no stop";
}

/// A snapshot that has the number of an order has its effect: replies to consoles wait for that.
TEST(StopControl, CountsTheOrdersThatWereCarriedOutForTheCheckpoint) {
  Stoppable s;
  const auto orders = [&s] {
    Checkpoint saved;
    s.stop.save(saved);
    EXPECT_EQ(saved.orders, s.stop.orders());
    return saved.orders;
  };
  EXPECT_EQ(orders(), 0u);
  s.stop.request(kNow, kOperator);
  EXPECT_EQ(orders(), 1u);
  s.stop.request(kNow, kOperator, Level::kPaused);
  EXPECT_EQ(orders(), 2u) << "also an order that changes nothing";
  s.stop.request(kNow, kObserver);
  EXPECT_EQ(s.stop.resume(kNow, kTraineeSeat, s.stop.latch().stops()), Result::kForbidden);
  EXPECT_EQ(orders(), 2u);
  EXPECT_EQ(s.stop.resume(kNow, kOperator, s.stop.latch().stops()), Result::kDone);
  EXPECT_EQ(orders(), 3u);
}

TEST(StopControl, GivesARoleThatMayOnlyPauseAPauseAndOthersNothing) {
  Stoppable s;
  EXPECT_EQ(s.stop.request(kNow, kTraineeSeat), Level::kPaused);
  EXPECT_EQ(s.event().what, What::kPause);
  EXPECT_EQ(s.stop.request(kNow, kObserver), std::nullopt);
  EXPECT_TRUE(s.events().empty());
  EXPECT_EQ(s.stop.latch().stops(), 1u);
}

TEST(StopControl, EndsOnlyTheNewestStopAndOnlyForPermittedRoles) {
  Stoppable s;
  EXPECT_EQ(s.stop.resume(kNow, kOperator, 0), Result::kOutdated) << "nothing is stopped";
  s.stop.request(kNow, kOperator);
  s.stop.request(kNow, kInstructorSeat);
  static_cast<void>(s.events());
  EXPECT_EQ(s.stop.resume(kNow, kOperator, 1), Result::kOutdated);
  EXPECT_EQ(s.stop.resume(kNow, kTraineeSeat, 2), Result::kForbidden);
  EXPECT_TRUE(s.events().empty());
  EXPECT_EQ(s.stop.resume(kNow, kInstructorSeat, 2), Result::kDone);
  const AuditEvent e = s.event();
  EXPECT_TRUE(e.what == What::kResume && e.seat == 0 && e.version == 2);
}

TEST(StopControl, StopsOnceForAFault) {
  Stoppable s;
  s.stop.stop_for_fault(kNow);
  const AuditEvent e = s.event();
  EXPECT_TRUE(e.what == What::kFault && e.seat == AuditEvent::kNoSeat && e.version == 1);
  EXPECT_EQ(s.stop.latch().latest().by, StopLatch::kNoSeat);
  s.stop.stop_for_fault(kNow);
  EXPECT_TRUE(s.events().empty());
  EXPECT_EQ(s.stop.latch().stops(), 1u);
}

TEST(StopControl, ResumesAfterARestartWithoutTheMissingSeatsAndRaisesTheOldStopAgain) {
  for (const Level before : {Level::kNone, Level::kStopped}) {
    Stoppable s;
    Checkpoint from;
    from.begun = true;
    from.stop = before;
    from.stops = 6;
    s.start.restore(from);
    s.stop.restore(from);
    EXPECT_EQ(s.stop.latch().level(), Level::kNone) << "the waiting itself engages no hand";
    Checkpoint again;
    s.stop.save(again);
    EXPECT_EQ(again.stop, before) << "a second restart restores the same";
    EXPECT_EQ(again.stops, 7u);
    EXPECT_EQ(s.stop.resume(kNow, kOperator, 6), Result::kOutdated) << "the number of the time before";
    EXPECT_EQ(s.stop.resume(kNow, kTraineeSeat, 7), Result::kForbidden);
    EXPECT_TRUE(s.start.recovering());
    EXPECT_EQ(s.stop.resume(kNow, kInstructorSeat, 7), Result::kDone);
    const AuditEvent e = s.event();
    EXPECT_TRUE(e.what == What::kAllBack && e.seat == 0 && e.version == 7);
    EXPECT_FALSE(s.start.recovering());
    EXPECT_EQ(s.stop.latch().level(), before);
    EXPECT_EQ(s.stop.latch().stops(), before == Level::kNone ? 7u : 8u);
  }
}

TEST(StopControl, CountsStopsRestartsAndMovesApart) {
  Checkpoint kept;
  kept.begun = true;
  std::uint32_t newest = 0;
  const auto restored = [&](bool handed_over, bool stops) {
    kept.handed_over = handed_over;
    Stoppable s;
    s.start.restore(kept);
    s.stop.restore(kept);
    EXPECT_EQ(s.stop.resume(kNow, kOperator, ++newest), Result::kDone) << "the waiting after a restore has a number";
    newest += s.stop.latch().latched() ? 1 : 0;  // the stop of before is raised again
    if (stops) s.stop.request(kNow, kOperator), ++newest;
    s.start.save(kept);
    s.stop.save(kept);
    EXPECT_EQ(kept.stops, newest);
  };
  restored(false, true);
  restored(true, false);
  restored(false, true);
  EXPECT_EQ(kept.restores, (RestoreCounts{.restarts = 2, .moves = 1, .numbers = 5}));
  EXPECT_EQ(kept.stops - kept.restores->numbers, 2u) << "two orders to stop";

  Stoppable unknown;
  kept.restores.reset();
  unknown.start.restore(kept);
  unknown.stop.restore(kept);
  EXPECT_EQ(unknown.stop.restores(), std::nullopt);
}

TEST(StopControl, EndsAStopOfTheRecoveryBeforeTheRecovery) {
  Stoppable s;
  Checkpoint from;
  from.begun = true;
  s.start.restore(from);
  s.stop.restore(from);
  s.stop.request(kNow, kOperator);
  EXPECT_EQ(s.stop.resume(kNow, kOperator, s.stop.latch().stops()), Result::kDone);
  EXPECT_TRUE(s.start.recovering());
  EXPECT_EQ(s.stop.resume(kNow, kOperator, s.stop.latch().stops()), Result::kDone);
  EXPECT_FALSE(s.start.recovering());
}

TEST(StopControl, KeepsTheStopOfASessionThatHadNotBegun) {
  Stoppable s;
  Checkpoint from;
  from.stop = Level::kPaused;
  from.stops = 3;
  s.start.restore(from);
  s.stop.restore(from);
  EXPECT_EQ(s.stop.latch().level(), Level::kPaused);
  EXPECT_EQ(s.stop.latch().stops(), 3u);
}

}  // namespace
}  // namespace tandem::server
