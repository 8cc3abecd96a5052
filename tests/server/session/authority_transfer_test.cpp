// Announced changes of authority (ARCHITECTURE.md, invariant 53): scheduled at tick k, announced to both parties,
// executed at tick k + 50, or cancelled.
#include "server/session/authority_transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "server/session/session_command.h"
#include "tests/server/session/session_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace test;
using Result = CommandOutcome::Result;
using What = AuditEvent::What;
using wire::TransferNotice::kCancelled, wire::TransferNotice::kGaining, wire::TransferNotice::kLosing,
    wire::TransferNotice::kNone;

constexpr std::size_t kTrainer = 0, kTrainee = 1;
constexpr control::MasterArray kToTrainee{0, 1}, kToTrainer{1, 0};

/// A lesson in which the trainer has all authority. The scene's own change comes at 11.5 s.
struct Lesson : SessionFixture {
  explicit Lesson(Duration begin = 1500ms) : SessionFixture("free_motion") {
    run(begin);
    EXPECT_EQ(session->state(), wire::SessionState::kRunning);
    EXPECT_EQ(requested(), kToTrainer);
    drain();
  }
  [[nodiscard]] const control::MasterArray& requested() const { return session->tool(0).authority.requested(); }
  [[nodiscard]] const control::MasterArray& decided() const { return session->tool(0).transfer.scheduled(); }
  [[nodiscard]] double alpha(std::size_t i) const { return session->tool(0).authority.alpha(i); }
  [[nodiscard]] const wire::ForceMessage& told(std::size_t i) const { return seats[i].core->force(); }

  [[nodiscard]] SessionCommand command(const control::MasterArray& weights) const {
    return {rpc::SetAuthority{{}, 0, session->authority().version(), {weights[0], weights[1]}},
            AccessRole::kInstructor};
  }
  Result order(const control::MasterArray& weights) { return execute_command(*session, now, command(weights)).result; }
  void ticks(int n) { run(std::chrono::milliseconds(n)); }
  /// Runs ticks in which the server receives nothing from one seat.
  void ticks_without(std::size_t mute, int n) {
    for (int t = 0; t < n; ++t) {
      for (std::size_t i = 0; i < seats.size(); ++i)
        for (const Bytes& d : client_tick(i))
          if (i != mute) session->on_datagram(now, address(seats[i].at), d);
      to_clients(server_tick());
      now += 1ms;
    }
  }
  void drain() {
    while (const auto e = session->audit().poll()) {
      ++audit[e->what];
      last = *e;
    }
  }
  int noted(What what) {
    drain();
    return audit[what];
  }
  std::map<What, int> audit;
  AuditEvent last;
};

TEST(AuthorityTransfer, BeginsFiftyTicksAfterTheDecisionAndNotifiesBothSeatsMeanwhile) {
  Lesson l;
  const std::uint32_t version = l.session->authority().version(), tick = l.session->clock().session_tick();
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  EXPECT_EQ(l.session->authority().version(), version + 1) << "the winner is settled now";
  EXPECT_EQ(l.decided(), kToTrainee);
  EXPECT_EQ(l.noted(What::kAuthority), 1);
  EXPECT_EQ(l.last.tick, tick);
  EXPECT_EQ(l.last.after, kToTrainee);
  for (std::uint32_t n = 1; n <= 49; ++n) {
    l.ticks(1);
    ASSERT_EQ(l.requested(), kToTrainer) << n;
    ASSERT_EQ(l.alpha(kTrainer), 1) << n;
    EXPECT_EQ(l.told(kTrainee).transfer, kGaining);
    EXPECT_EQ(l.told(kTrainer).transfer, kLosing);
    for (const std::size_t i : {kTrainer, kTrainee}) EXPECT_EQ(l.told(i).transfer_ticks, 50 - n);
  }
  l.ticks(1);
  EXPECT_EQ(l.session->clock().session_tick(), tick + 50);
  EXPECT_EQ(l.requested(), kToTrainee);
  EXPECT_NEAR(l.alpha(kTrainee), l.scene.alpha_slew * 1e-3, 1e-9) << "with the slew there is";
  for (const std::size_t i : {kTrainer, kTrainee}) EXPECT_EQ(l.told(i).transfer, kNone);
  EXPECT_EQ(l.session->authority().version(), version + 1);
}

TEST(AuthorityTransfer, NamesTheDecidingRoleAndTheGainingSeat) {
  Lesson l;
  const auto both = [&] { return std::pair{l.told(kTrainer).transfer_parties, l.told(kTrainee).transfer_parties}; };
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(2);
  const wire::TransferParties by_operator{.by = wire::TransferParties::kOperator, .to = kTrainee + 1, .percent = 100};
  EXPECT_EQ(both(), std::pair(by_operator, by_operator));
  l.ticks(1500);
  EXPECT_EQ(both(), std::pair(wire::TransferParties{}, wire::TransferParties{})) << "it was applied";
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{0.25, 0.75}));
  l.ticks(5);
  const wire::TransferParties by_trainer{.by = kTrainer + 1, .to = kTrainer + 1, .percent = 25};
  EXPECT_EQ(both(), std::pair(by_trainer, by_trainer));
  l.ticks(1500);
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{1.0, 0.0}));
  while (l.session->clock().time() < 11.46) l.ticks(1);
  const wire::TransferParties by_scene{.by = wire::TransferParties::kScene, .to = kTrainee + 1, .percent = 100};
  EXPECT_EQ(both(), std::pair(by_scene, by_scene)) << "the scene's own change at 11.5 s";
}

/// Key presses come faster than the server replies: the second step is requested before the version of the first one
/// is known.
TEST(AuthorityTransfer, AppliesAllStepsThatASeatRequestsBeforeTheFirstReply) {
  Lesson l;
  const std::uint32_t version = l.session->authority().version();
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{0.95, 0.05}));
  for (const Bytes& d : l.client_tick(kTrainer)) l.session->on_datagram(l.now, address(l.seats[kTrainer].at), d);
  ASSERT_EQ(l.session->authority().version(), version + 1);
  ASSERT_EQ(l.told(kTrainer).authority_version, version) << "not known to the seat yet";
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{0.9, 0.1}));
  l.ticks(1500);
  EXPECT_EQ(l.session->authority().version(), version + 2);
  EXPECT_NEAR(l.requested()[kTrainer], 0.9, 1e-12);
}

/// Compare-and-set protects other participants: the second step does not overwrite a change that an operator made
/// meanwhile.
TEST(AuthorityTransfer, DropsARequestThatAnOperatorsDecisionOvertook) {
  Lesson l;
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{0.95, 0.05}));
  const auto on_their_way = l.client_tick(kTrainer);
  ASSERT_EQ(l.order({0.5, 0.5}), Result::kDone);
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{0.9, 0.1}));
  for (const Bytes& d : on_their_way) l.session->on_datagram(l.now, address(l.seats[kTrainer].at), d);
  l.ticks(1500);
  EXPECT_NEAR(l.requested()[kTrainer], 0.5, 1e-12);
}

TEST(AuthorityTransfer, IsRejectedWhileALinkOfAPartyIsOlderThan20Milliseconds) {
  for (const std::size_t mute : {kTrainer, kTrainee}) {
    SCOPED_TRACE(mute);
    Lesson young, old;
    young.ticks_without(mute, 19);  // plus the current millisecond
    EXPECT_EQ(young.order(kToTrainee), Result::kDone) << "20 ms";
    old.ticks_without(mute, 20);
    const std::uint32_t version = old.session->authority().version();
    for (int n = 0; n < 50; ++n) EXPECT_EQ(old.order(kToTrainee), Result::kStaleLink) << "21 ms";
    EXPECT_EQ(old.session->authority().version(), version);
    EXPECT_EQ(old.decided(), kToTrainer);
    EXPECT_EQ(old.noted(What::kAuthorityRejected), 1) << "a client repeats what it asks for: once a second is enough";
    EXPECT_EQ(old.last.party, mute);
    EXPECT_EQ(old.noted(What::kAuthority), 0);
    old.ticks(1500);  // the age of the loop made the seat's own gate release too
    EXPECT_EQ(old.order(kToTrainee), Result::kDone) << "its datagrams arrive again";
  }
}

TEST(AuthorityTransfer, IsCancelledWhenTheGainingSeatIsSilentAtItsTick) {
  Lesson young, old;
  ASSERT_EQ(young.order(kToTrainee), Result::kDone);
  young.ticks(30);
  young.ticks_without(kTrainee, 20);
  EXPECT_EQ(young.requested(), kToTrainee) << "20 ms";

  const std::uint32_t version = old.session->authority().version();
  ASSERT_EQ(old.order(kToTrainee), Result::kDone);
  old.ticks(29);
  old.ticks_without(kTrainee, 21);
  EXPECT_EQ(old.requested(), kToTrainer) << "21 ms";
  EXPECT_EQ(old.decided(), kToTrainer);
  EXPECT_EQ(old.session->authority().version(), version + 2) << "the change of version + 1 is void";
  EXPECT_EQ(old.noted(What::kAuthorityCancelled), 1);
  EXPECT_EQ(old.last.party, kTrainee);
  EXPECT_EQ(old.last.before, kToTrainee);
  EXPECT_EQ(old.last.after, kToTrainer);
  for (const std::size_t i : {kTrainer, kTrainee}) EXPECT_EQ(old.told(i).transfer, kCancelled);
  old.ticks(99);
  EXPECT_EQ(old.told(kTrainer).transfer, kCancelled);
  old.ticks(1);
  EXPECT_EQ(old.told(kTrainer).transfer, kNone);
  EXPECT_EQ(old.alpha(kTrainer), 1);
}

// The holder is lost within the 50 ticks. Its authority goes to the announced seat, as fast as a lost holder's does.
TEST(AuthorityTransfer, ContinuesWhenTheHolderIsLost) {
  Lesson l;
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks_without(kTrainer, 50);
  EXPECT_EQ(l.requested(), kToTrainee);
  bool held = false;
  for (int n = 50; n < 620; ++n) {  // 450 ms until a leader counts as lost, then 100 ms to move its authority
    l.ticks_without(kTrainer, 1);
    held |= l.session->tool(0).authority.held();
  }
  EXPECT_EQ(l.alpha(kTrainer), 0);
  EXPECT_EQ(l.alpha(kTrainee), 1);
  EXPECT_FALSE(held);
  EXPECT_EQ(l.noted(What::kAuthorityCancelled), 0);
}

TEST(AuthorityTransfer, IsRejectedToAnAbsentSeatAndAcceptedFromOne) {
  Lesson to, from;
  to.ticks_without(kTrainee, 500);
  EXPECT_EQ(to.order({0.5, 0.5}), Result::kStaleLink);
  ASSERT_EQ(from.order({0.5, 0.5}), Result::kDone);
  from.ticks(600);
  from.ticks_without(kTrainee, 500);
  EXPECT_EQ(from.order(kToTrainer), Result::kDone);
  from.ticks_without(kTrainee, 50);
  EXPECT_EQ(from.requested(), kToTrainer);
}

// Each decision is executed after its own 50 ticks: a ramp stays a ramp, and a change that is taken back lasts only as
// long as requested.
TEST(AuthorityTransfer, ExecutesEachDecisionAfterItsOwnDelay) {
  Lesson l;
  const control::MasterArray first{0.4, 0.6}, second{0.2, 0.8};
  ASSERT_EQ(l.order(first), Result::kDone);
  l.ticks(10);
  ASSERT_EQ(l.order(second), Result::kDone);
  EXPECT_EQ(l.decided(), second);
  l.ticks(39);
  EXPECT_EQ(l.requested(), kToTrainer);
  EXPECT_EQ(l.told(kTrainee).transfer, kGaining);
  EXPECT_EQ(l.told(kTrainee).transfer_ticks, 11u) << "the last decision";
  l.ticks(1);
  EXPECT_EQ(l.requested(), first);
  l.ticks(9);
  EXPECT_EQ(l.requested(), first);
  l.ticks(1);
  EXPECT_EQ(l.requested(), second);
}

TEST(AuthorityTransfer, AppliesTheLaterOfTwoDecisionsOfOneTick) {
  Lesson l;
  ASSERT_EQ(l.order({0.4, 0.6}), Result::kDone);
  ASSERT_EQ(l.order({0.3, 0.7}), Result::kDone) << "the request has the version of the first one";
  l.ticks(50);
  EXPECT_EQ(l.requested(), (control::MasterArray{0.3, 0.7}));
}

TEST(AuthorityTransfer, IsAnnouncedDuringAStopAndActsAfterTheResume) {
  Lesson l;
  ASSERT_TRUE(l.session->stop_control().request(l.now, {AccessRole::kInstructor}));
  l.ticks(300);
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(1);
  EXPECT_EQ(l.told(kTrainee).transfer, kGaining) << "else the trainee's hand leads after the stop without a notice";
  EXPECT_EQ(l.told(kTrainer).transfer, wire::TransferNotice::kLosing);
  l.ticks(60);
  EXPECT_EQ(l.told(kTrainee).transfer, kNone);
  EXPECT_EQ(l.alpha(kTrainee), 0);
  ASSERT_EQ(
      l.session->stop_control().resume(l.now, {AccessRole::kInstructor}, l.session->stop_control().latch().stops()),
      CommandResult::kDone);
  l.ticks(1000);
  EXPECT_EQ(l.alpha(kTrainee), 1);
}

TEST(AuthorityTransfer, WithdrawsTheNoticeOfATimelineChangeDuringAStop) {
  Lesson l;
  l.ticks(static_cast<int>(std::lround(l.scene.timeline[0].at * l.scene.tick_hz)) - 30 -
          static_cast<int>(l.session->clock().session_tick()));
  ASSERT_EQ(l.told(kTrainee).transfer, kGaining);
  ASSERT_TRUE(l.session->stop_control().request(l.now, {AccessRole::kInstructor}));
  l.ticks(2);
  EXPECT_EQ(l.told(kTrainee).transfer, kNone);
}

TEST(AuthorityTransfer, MovesNoAuthorityDuringAStop) {
  Lesson l;
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(10);
  ASSERT_TRUE(l.session->stop_control().request(l.now, {AccessRole::kInstructor}));
  l.ticks(1);
  EXPECT_TRUE(l.session->tool(0).authority.held()) << "a stop takes all weight at once";
  l.ticks(39);
  EXPECT_EQ(l.requested(), kToTrainee) << "on paper";
  EXPECT_EQ(l.alpha(kTrainee), 0);
  EXPECT_TRUE(l.session->tool(0).authority.held());
  ASSERT_EQ(
      l.session->stop_control().resume(l.now, {AccessRole::kInstructor}, l.session->stop_control().latch().stops()),
      CommandResult::kDone);
  l.ticks(1000);
  EXPECT_EQ(l.alpha(kTrainee), 1) << "as it was decided before the stop";
}

TEST(AuthorityTransfer, AnnouncesATimelineChangeAndBeginsItOnTime) {
  Lesson l;
  ASSERT_EQ(l.scene.timeline.size(), 1u);
  const auto at = static_cast<std::uint32_t>(std::lround(l.scene.timeline[0].at * l.scene.tick_hz));
  l.ticks(static_cast<int>(at - 51 - l.session->clock().session_tick()));
  EXPECT_EQ(l.decided(), kToTrainer);
  l.ticks(1);
  EXPECT_EQ(l.decided(), kToTrainee);
  EXPECT_EQ(l.told(kTrainee).transfer, kGaining);
  EXPECT_EQ(l.told(kTrainee).transfer_ticks, 50u);
  l.ticks(49);
  EXPECT_EQ(l.requested(), kToTrainer);
  l.ticks(1);
  EXPECT_EQ(l.session->clock().session_tick(), at);
  EXPECT_EQ(l.requested(), kToTrainee);
}

TEST(AuthorityTransfer, DefersATimelineChangeUntilTheGainingSeatResponds) {
  Lesson l;
  l.ticks(static_cast<int>(std::lround(l.scene.timeline[0].at * l.scene.tick_hz)) - 30 -
          static_cast<int>(l.session->clock().session_tick()));
  l.ticks_without(kTrainee, 230);
  EXPECT_EQ(l.requested(), kToTrainer);
  EXPECT_EQ(l.alpha(kTrainer), 1) << "the tool keeps a seat with authority";
  EXPECT_EQ(l.noted(What::kAuthorityDeferred), 1) << "reported once";
  EXPECT_EQ(l.decided(), kToTrainee);
  l.ticks(2000);
  EXPECT_EQ(l.requested(), kToTrainee);
  EXPECT_EQ(l.alpha(kTrainee), 1);
}

TEST(AuthorityTransfer, IsStoredInTheCheckpointOnceDecided) {
  Lesson l;
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(3);
  EXPECT_EQ(l.requested(), kToTrainer);
  EXPECT_EQ(l.session->checkpoint().tools[0].alpha, kToTrainee)
      << "after a restart the scene would not repeat the change";
}

// A request that is not granted within a second is dropped: it would take effect much later, unexpectedly.
TEST(AuthorityTransfer, DropsARequestThatIsNotGrantedWithinASecond) {
  Lesson l;
  l.ticks_without(kTrainee, 300);
  ASSERT_TRUE(l.seats[kTrainer].core->requests().change_authority(0, std::array{0.0, 1.0}));
  l.ticks_without(kTrainee, 1);
  EXPECT_EQ(l.told(kTrainer).transfer, kCancelled);
  l.ticks_without(kTrainee, 1100);
  EXPECT_LE(l.noted(What::kAuthorityRejected), 2);
  EXPECT_EQ(l.told(kTrainer).transfer, kNone);
  l.ticks(2000);
  EXPECT_EQ(l.decided(), kToTrainer);
}

TEST(AuthorityTransfer, TakesNoHeap) {
  Lesson l;
  std::array<std::byte, transport::kDatagramMax> buffer;
  for (int n = 0; n < 120; ++n) {
    for (std::size_t i = 0; i < l.seats.size(); ++i) {
      const auto sent = l.client_tick(i);
      const tandem::test::AllocGuard guard;
      for (const Bytes& d : sent) l.session->on_datagram(l.now, address(l.seats[i].at), d);
      EXPECT_EQ(guard.count(), 0u);
    }
    const SessionCommand command = l.command(n % 2 == 0 ? kToTrainee : kToTrainer);
    const tandem::test::AllocGuard guard;
    if (n % 7 == 0) static_cast<void>(execute_command(*l.session, l.now, command));
    l.session->on_tick(l.now, 0);
    while (l.session->poll_transmit(l.now, buffer)) {
    }
    EXPECT_EQ(guard.count(), 0u);
    l.now += 1ms;
  }
}

/// AuthorityTransfer alone, tick by tick.
TEST(AuthorityTransferDelay, ExecutesInOrderAndAppliesTheLastDecisionLast) {
  const auto change = [](double a) { return server::AuthorityTransfer::Change{.wanted = {a, 1 - a}}; };
  server::AuthorityTransfer h;
  h.set_initial({1, 0});
  h.schedule({0.5, 0.5}, change(0.5), 50);
  h.tick();
  // A change of the scene, scheduled later but due earlier: it removes the changes due after it.
  h.schedule({0.25, 0.75}, change(0.25), 20);
  std::vector<std::pair<int, double>> acted;
  for (int n = 2; n <= 120; ++n) {
    h.tick();
    if (const auto* due = h.due()) acted.emplace_back(n, due->wanted[0]);
    EXPECT_EQ(h.due(), nullptr) << "once";
  }
  EXPECT_EQ(acted, (std::vector<std::pair<int, double>>{{21, 0.25}}));
  h.schedule({0, 1}, change(0), 0);
  ASSERT_NE(h.due(), nullptr) << "in this very tick";
  EXPECT_FALSE(h.pending());
}

}  // namespace
}  // namespace tandem::server
