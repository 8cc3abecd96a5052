// Requests for authority, without clients: permission, version, timeline and notice. With clients:
// authority_transfer_test.cpp.
#include "server/session/authority_control.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using test::SessionParts;
using Result = CommandResult;
using What = AuditEvent::What;

constexpr Time kNow{std::chrono::hours(1)};
constexpr std::size_t kTrainer = 0, kTrainee = 1;
constexpr Requester kInstructor = requester_at(kTrainer, AccessRole::kInstructor);

/// free_motion: the trainer has all authority, the timeline gives it to the trainee at 11.5 s. No seat is present, so
/// the tool is braked and no link is judged.
struct Lesson : SessionParts {
  Lesson() : SessionParts("free_motion") {}
  Result request(const Requester& by, double trainer, double trainee, std::uint32_t version, std::uint32_t tool = 0) {
    return control.request(kNow, by, {.version = version, .tool = tool, .masters = 2, .alpha = {trainer, trainee}});
  }
  Result request(const Requester& by, double trainer, double trainee) {
    return request(by, trainer, trainee, control.version());
  }
  void ticks(int n) {
    for (int i = 0; i < n; ++i) {
      control.step(kNow, false);
      clock.advance(false);
    }
  }
  wire::ForceMessage notice(std::size_t seat, bool clock_stopped = false) {
    wire::ForceMessage m;
    control.fill_notice(seat, clock_stopped, m);
    return m;
  }
  [[nodiscard]] const control::MasterArray& requested() const { return tools[0].authority.requested(); }
  AuthorityControl control{scene, clock, tools, seats, present, audit};
};

TEST(AuthorityControl, CountsTheScenesRowsAndEveryDecision) {
  Lesson l;
  EXPECT_EQ(l.control.version(), 2u) << "1, and one row of authority";
  EXPECT_EQ(l.requested()[kTrainer], 1);
  EXPECT_EQ(l.request(kInstructor, 0.4, 0.6), Result::kDone);
  EXPECT_EQ(l.control.version(), 3u);
  EXPECT_EQ(l.request(kInstructor, 0.5, 0.5, 2), Result::kOutdated);
  EXPECT_EQ(l.request(kInstructor, 0.5, 0.5, 4), Result::kOutdated) << "a version that does not exist yet";
  EXPECT_EQ(l.control.version(), 3u);
  const auto events = l.events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(events[0].what == What::kAuthority && events[0].seat == kTrainer && events[0].version == 3);
  EXPECT_EQ(events[0].before[kTrainer], 1);
  EXPECT_EQ(events[0].after[kTrainee], 0.6);
}

TEST(AuthorityControl, RejectsWhatIsNoAuthorityOverATool) {
  Lesson l;
  EXPECT_EQ(l.request(kInstructor, 1, 0, 2, 1), Result::kInvalid) << "there is one tool";
  EXPECT_EQ(l.control.request(kNow, kInstructor, {.version = 2, .tool = 0, .masters = 3, .alpha = {1, 0}}),
            Result::kInvalid);
  EXPECT_EQ(l.request(kInstructor, 0.5, 0.6), Result::kInvalid) << "the sum is not 1";
  EXPECT_EQ(l.request(kInstructor, 1.5, -0.5), Result::kInvalid);
  EXPECT_EQ(l.control.version(), 2u);
  EXPECT_TRUE(l.events().empty());
}

TEST(AuthorityControl, LetsATraineeGiveUpItsOwnAuthorityToAnInstructorOnly) {
  const Requester trainee = requester_at(kTrainee, AccessRole::kTrainee);
  Lesson l;
  EXPECT_EQ(l.request(trainee, 0.9, 0.1), Result::kForbidden) << "it takes authority";
  ASSERT_EQ(l.request(kInstructor, 0.4, 0.6), Result::kDone);
  EXPECT_EQ(l.request(trainee, 0.3, 0.7), Result::kForbidden);
  EXPECT_EQ(l.request(trainee, 0.7, 0.3), Result::kDone);
  for (const AccessRole role : {AccessRole::kEvaluator, AccessRole::kObserver, AccessRole::kOperator})
    EXPECT_EQ(l.request({role}, 1, 0), Result::kForbidden) << to_text(role);
}

TEST(AuthorityControl, GivesNoAuthorityToASeatThatMayNotDrive) {
  SessionParts parts("eight_seats");
  AuthorityControl control{parts.scene, parts.clock, parts.tools, parts.seats, parts.present, parts.audit};
  wire::AuthorityMessage wish{.version = control.version(), .tool = 0, .masters = 8, .alpha = {0.5, 0.5}};
  EXPECT_EQ(control.request(kNow, {AccessRole::kInstructor}, wish), Result::kForbidden) << "seat 1 is an evaluator's";
}

TEST(AuthorityControl, NotifiesForFiftyTicksAndThenExecutes) {
  Lesson l;
  l.clock.begin();
  ASSERT_EQ(l.request(kInstructor, 0.25, 0.75), Result::kDone);
  for (std::uint32_t n = 0; n < 50; ++n) {
    EXPECT_EQ(l.requested()[kTrainer], 1) << n;
    EXPECT_EQ(l.notice(kTrainee).transfer, wire::TransferNotice::kGaining);
    EXPECT_EQ(l.notice(kTrainer).transfer, wire::TransferNotice::kLosing);
    EXPECT_EQ(l.notice(kTrainee).transfer_ticks, 50 - n);
    const wire::TransferParties parties{.by = kTrainer + 1, .to = kTrainee + 1, .percent = 75};
    EXPECT_EQ(l.notice(kTrainer).transfer_parties, parties);
    l.ticks(1);
  }
  EXPECT_EQ(l.requested()[kTrainee], 0.75);
  EXPECT_EQ(l.notice(kTrainee).transfer, wire::TransferNotice::kNone);
}

TEST(AuthorityControl, AnnouncesTheTimelineFiftyTicksAheadAndWaitsWithTheClock) {
  Lesson l;
  l.clock.restore(11'449);
  l.clock.resume();
  l.ticks(1);
  EXPECT_EQ(l.control.version(), 2u) << "51 ticks before 11.5 s";
  l.ticks(1);
  EXPECT_EQ(l.control.version(), 3u);
  ASSERT_EQ(l.events().back().seat, AuditEvent::kTimeline);
  EXPECT_EQ(l.notice(kTrainee).transfer_ticks, 50u);
  for (int n = 0; n < 100; ++n) l.control.step(kNow, true);
  EXPECT_EQ(l.notice(kTrainee).transfer_ticks, 50u) << "the clock is stopped";
  EXPECT_EQ(l.notice(kTrainee, true).transfer, wire::TransferNotice::kNone);
  l.ticks(49);
  EXPECT_EQ(l.requested()[kTrainer], 1);
  l.ticks(1);
  EXPECT_EQ(l.requested()[kTrainee], 1);
}

TEST(AuthorityControl, RejectsAnAbsentPartyAndReportsItToTheSeatThatAsked) {
  Lesson l;
  l.present[kTrainer] = true;
  l.step_authority();
  ASSERT_FALSE(l.tools[0].authority.held());
  l.present[kTrainer] = false;  // it leaves; in this tick it still has authority
  EXPECT_EQ(l.request(kInstructor, 0, 1), Result::kStaleLink);
  EXPECT_EQ(l.request(kInstructor, 0, 1), Result::kStaleLink);
  const auto events = l.events();
  ASSERT_EQ(events.size(), 1u) << "at most one per second";
  EXPECT_TRUE(events[0].what == What::kAuthorityRejected && events[0].party == kTrainee);
  EXPECT_EQ(l.control.version(), 2u);
  for (int n = 0; n < 100; ++n) EXPECT_EQ(l.notice(kTrainer).transfer, wire::TransferNotice::kCancelled) << n;
  EXPECT_EQ(l.notice(kTrainer).transfer, wire::TransferNotice::kNone) << "after 0.1 s";
  EXPECT_EQ(l.notice(kTrainee).transfer, wire::TransferNotice::kNone) << "it did not ask";
}

TEST(AuthorityControl, RestoresACheckpointAndSkipsItsPastTimeline) {
  for (const std::uint32_t tick : {11'449u, 11'450u}) {
    Lesson l;
    Checkpoint from;
    from.begun = true;
    from.authority_version = 9;
    from.tools[0].alpha = {0.5, 0.5};
    l.clock.restore(tick);
    l.control.restore(from);
    EXPECT_EQ(l.control.version(), 10u);
    EXPECT_EQ(l.requested()[kTrainee], 0.5);
    EXPECT_EQ(l.tools[0].transfer.scheduled()[kTrainee], 0.5);
    Checkpoint again;
    l.control.save(again);
    EXPECT_EQ(again.authority_version, 10u);
    EXPECT_EQ(again.tools[0].alpha, from.tools[0].alpha);
    l.clock.resume();
    l.ticks(200);
    EXPECT_EQ(l.requested()[kTrainee], tick == 11'449 ? 1 : 0.5) << "announced 50 ticks ahead, at tick 11 450";
  }
}

}  // namespace
}  // namespace tandem::server
