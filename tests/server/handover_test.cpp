// Authority announced ahead (design notes, security 2.5): decided at tick k, told to both, begun at tick k + 50; or called off.
#include "server/handover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "server/command.h"
#include "tests/server/rig.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace test;
using Result = Outcome::Result;
using What = AuditEvent::What;
using wire::Handover::kCalledOff, wire::Handover::kComes, wire::Handover::kGoes, wire::Handover::kNone;

constexpr std::size_t kTrainer = 0, kTrainee = 1;
constexpr control::Weights kToTrainee{0, 1}, kToTrainer{1, 0};

/// A lesson in which the trainer has all weight; the scene's own change comes at 11.5 s.
struct Lesson : Rig {
  explicit Lesson(Duration begin = 1500ms) : Rig("free_motion") {
    run(begin);
    EXPECT_EQ(session->state(), wire::SessionState::kRunning);
    EXPECT_EQ(requested(), kToTrainer);
    drain();
  }
  [[nodiscard]] const control::Weights& requested() const { return session->tool(0).authority.requested(); }
  [[nodiscard]] const control::Weights& decided() const { return session->tool(0).handover.decided(); }
  [[nodiscard]] double alpha(std::size_t i) const { return session->tool(0).authority.alpha(i); }
  [[nodiscard]] const wire::ForceMessage& told(std::size_t i) const { return seats[i].core->force(); }

  Result order(const control::Weights& weights) {
    Command c;
    c.what = Command::What::kSetAuthority;
    c.who = AccessRole::kInstructor;
    c.wish = {.version = session->authority_version(), .tool = 0, .masters = 2, .alpha = weights};
    return carry_out(*session, now, c).result;
  }
  void ticks(int n) { run(std::chrono::milliseconds(n)); }
  /// Ticks in which the server hears nothing of one seat.
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
    while (const auto e = session->poll_audit()) {
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

TEST(Handover, BeginsFiftyTicksAfterTheDecisionAndBothAreToldAllTheWhile) {
  Lesson l;
  const std::uint32_t version = l.session->authority_version(), tick = l.session->session_tick();
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  EXPECT_EQ(l.session->authority_version(), version + 1) << "who wins is settled now";
  EXPECT_EQ(l.decided(), kToTrainee);
  EXPECT_EQ(l.noted(What::kAuthority), 1);
  EXPECT_EQ(l.last.tick, tick);
  EXPECT_EQ(l.last.after, kToTrainee);
  for (std::uint32_t n = 1; n <= 49; ++n) {
    l.ticks(1);
    ASSERT_EQ(l.requested(), kToTrainer) << n;
    ASSERT_EQ(l.alpha(kTrainer), 1) << n;
    EXPECT_EQ(l.told(kTrainee).handover, kComes);
    EXPECT_EQ(l.told(kTrainer).handover, kGoes);
    for (const std::size_t i : {kTrainer, kTrainee}) EXPECT_EQ(l.told(i).handover_ticks, 50 - n);
  }
  l.ticks(1);
  EXPECT_EQ(l.session->session_tick(), tick + 50);
  EXPECT_EQ(l.requested(), kToTrainee);
  EXPECT_NEAR(l.alpha(kTrainee), l.scene.alpha_slew * 1e-3, 1e-9) << "with the slew there is";
  for (const std::size_t i : {kTrainer, kTrainee}) EXPECT_EQ(l.told(i).handover, kNone);
  EXPECT_EQ(l.session->authority_version(), version + 1);
}

TEST(Handover, SaysWhoDecidedItAndWhoGains) {
  Lesson l;
  const auto both = [&] { return std::pair{l.told(kTrainer).handover_parties, l.told(kTrainee).handover_parties}; };
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(2);
  const wire::HandoverParties by_operator{.by = wire::HandoverParties::kOperator, .to = kTrainee + 1, .percent = 100};
  EXPECT_EQ(both(), std::pair(by_operator, by_operator));
  l.ticks(1500);
  EXPECT_EQ(both(), std::pair(wire::HandoverParties{}, wire::HandoverParties{})) << "it was carried out";
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{0.25, 0.75}));
  l.ticks(5);
  const wire::HandoverParties by_trainer{.by = kTrainer + 1, .to = kTrainer + 1, .percent = 25};
  EXPECT_EQ(both(), std::pair(by_trainer, by_trainer));
  l.ticks(1500);
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{1.0, 0.0}));
  while (l.session->time() < 11.46) l.ticks(1);
  const wire::HandoverParties by_scene{.by = wire::HandoverParties::kScene, .to = kTrainee + 1, .percent = 100};
  EXPECT_EQ(both(), std::pair(by_scene, by_scene)) << "the scene's own change at 11.5 s";
}

/// Keys come faster than the server answers: the second step is asked for before the first one's new version is known.
TEST(Handover, StepsThatASeatAsksForBeforeTheFirstIsKnownAreAllCarriedOut) {
  Lesson l;
  const std::uint32_t version = l.session->authority_version();
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{0.95, 0.05}));
  for (const Bytes& d : l.client_tick(kTrainer)) l.session->on_datagram(l.now, address(l.seats[kTrainer].at), d);
  ASSERT_EQ(l.session->authority_version(), version + 1);
  ASSERT_EQ(l.told(kTrainer).authority_version, version) << "not known to the seat yet";
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{0.9, 0.1}));
  l.ticks(1500);
  EXPECT_EQ(l.session->authority_version(), version + 2);
  EXPECT_NEAR(l.requested()[kTrainer], 0.9, 1e-12);
}

/// Compare and set is for two persons: the second step does not overwrite what an operator decided meanwhile.
TEST(Handover, AStepThatAnotherPersonsDecisionOvertookIsNotAskedForAgain) {
  Lesson l;
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{0.95, 0.05}));
  const auto on_their_way = l.client_tick(kTrainer);
  ASSERT_EQ(l.order({0.5, 0.5}), Result::kDone);
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{0.9, 0.1}));
  for (const Bytes& d : on_their_way) l.session->on_datagram(l.now, address(l.seats[kTrainer].at), d);
  l.ticks(1500);
  EXPECT_NEAR(l.requested()[kTrainer], 0.5, 1e-12);
}

TEST(Handover, IsRefusedWhileALinkOfThoseItConcernsIsOlderThan20Milliseconds) {
  for (const std::size_t mute : {kTrainer, kTrainee}) {
    SCOPED_TRACE(mute);
    Lesson young, old;
    young.ticks_without(mute, 19);  // and the millisecond until now
    EXPECT_EQ(young.order(kToTrainee), Result::kDone) << "20 ms";
    old.ticks_without(mute, 20);
    const std::uint32_t version = old.session->authority_version();
    for (int n = 0; n < 50; ++n) EXPECT_EQ(old.order(kToTrainee), Result::kOutOfTouch) << "21 ms";
    EXPECT_EQ(old.session->authority_version(), version);
    EXPECT_EQ(old.decided(), kToTrainer);
    EXPECT_EQ(old.noted(What::kAuthorityRefused), 1) << "a client repeats what it asks for: once a second is enough";
    EXPECT_EQ(old.last.party, mute);
    EXPECT_EQ(old.noted(What::kAuthority), 0);
    old.ticks(1500);  // the loop's age made his own gate let go as well
    EXPECT_EQ(old.order(kToTrainee), Result::kDone) << "heard from again";
  }
}

TEST(Handover, IsCalledOffWhenWhoGainsIsNotHeardFromAtItsTick) {
  Lesson young, old;
  ASSERT_EQ(young.order(kToTrainee), Result::kDone);
  young.ticks(30);
  young.ticks_without(kTrainee, 20);
  EXPECT_EQ(young.requested(), kToTrainee) << "20 ms";

  const std::uint32_t version = old.session->authority_version();
  ASSERT_EQ(old.order(kToTrainee), Result::kDone);
  old.ticks(29);
  old.ticks_without(kTrainee, 21);
  EXPECT_EQ(old.requested(), kToTrainer) << "21 ms";
  EXPECT_EQ(old.decided(), kToTrainer);
  EXPECT_EQ(old.session->authority_version(), version + 2) << "what version + 1 stood for is not so";
  EXPECT_EQ(old.noted(What::kAuthorityCalledOff), 1);
  EXPECT_EQ(old.last.party, kTrainee);
  EXPECT_EQ(old.last.before, kToTrainee);
  EXPECT_EQ(old.last.after, kToTrainer);
  for (const std::size_t i : {kTrainer, kTrainee}) EXPECT_EQ(old.told(i).handover, kCalledOff);
  old.ticks(99);
  EXPECT_EQ(old.told(kTrainer).handover, kCalledOff);
  old.ticks(1);
  EXPECT_EQ(old.told(kTrainer).handover, kNone);
  EXPECT_EQ(old.alpha(kTrainer), 1);
}

// Who loses is lost himself within the 50 ticks: his weight goes to whom it was promised, as fast as a lost holder's does.
TEST(Handover, OfAHolderWhoIsLostMeanwhileGoesOn) {
  Lesson l;
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks_without(kTrainer, 50);
  EXPECT_EQ(l.requested(), kToTrainee);
  bool held = false;
  for (int n = 50; n < 620; ++n) {  // 450 ms until a leader counts as lost, and his weight moves within 100 ms
    l.ticks_without(kTrainer, 1);
    held |= l.session->tool(0).authority.held();
  }
  EXPECT_EQ(l.alpha(kTrainer), 0);
  EXPECT_EQ(l.alpha(kTrainee), 1);
  EXPECT_FALSE(held);
  EXPECT_EQ(l.noted(What::kAuthorityCalledOff), 0);
}

TEST(Handover, ToSomebodyWhoIsNotThereIsRefusedAndFromHimIsNot) {
  Lesson to, from;
  to.ticks_without(kTrainee, 500);
  EXPECT_EQ(to.order({0.5, 0.5}), Result::kOutOfTouch);
  ASSERT_EQ(from.order({0.5, 0.5}), Result::kDone);
  from.ticks(600);
  from.ticks_without(kTrainee, 500);
  EXPECT_EQ(from.order(kToTrainer), Result::kDone);
  from.ticks_without(kTrainee, 50);
  EXPECT_EQ(from.requested(), kToTrainer);
}

// Everybody's decision is carried out after its own 50 ticks: a ramp stays a ramp, and what is taken back is given for so long only.
TEST(Handover, ASecondDecisionWithinTheTimeHasATimeOfItsOwn) {
  Lesson l;
  const control::Weights first{0.4, 0.6}, second{0.2, 0.8};
  ASSERT_EQ(l.order(first), Result::kDone);
  l.ticks(10);
  ASSERT_EQ(l.order(second), Result::kDone);
  EXPECT_EQ(l.decided(), second);
  l.ticks(39);
  EXPECT_EQ(l.requested(), kToTrainer);
  EXPECT_EQ(l.told(kTrainee).handover, kComes);
  EXPECT_EQ(l.told(kTrainee).handover_ticks, 11u) << "the last decision";
  l.ticks(1);
  EXPECT_EQ(l.requested(), first);
  l.ticks(9);
  EXPECT_EQ(l.requested(), first);
  l.ticks(1);
  EXPECT_EQ(l.requested(), second);
}

TEST(Handover, OfOneTickTheLaterDecisionActs) {
  Lesson l;
  ASSERT_EQ(l.order({0.4, 0.6}), Result::kDone);
  ASSERT_EQ(l.order({0.3, 0.7}), Result::kDone) << "he named the version of the first";
  l.ticks(50);
  EXPECT_EQ(l.requested(), (control::Weights{0.3, 0.7}));
}

TEST(Handover, OrderedInAStopIsToldAtOnceAndActsWhenTheSessionGoesOn) {
  Lesson l;
  ASSERT_TRUE(l.session->stop_hands(l.now, AccessRole::kInstructor));
  l.ticks(300);
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(1);
  EXPECT_EQ(l.told(kTrainee).handover, kComes) << "else the trainee's hand leads after the stop and nobody said so";
  EXPECT_EQ(l.told(kTrainer).handover, wire::Handover::kGoes);
  l.ticks(60);
  EXPECT_EQ(l.told(kTrainee).handover, kNone);
  EXPECT_EQ(l.alpha(kTrainee), 0);
  ASSERT_TRUE(l.session->resume_hands(l.now, AccessRole::kInstructor, l.session->stops()));
  l.ticks(1000);
  EXPECT_EQ(l.alpha(kTrainee), 1);
}

TEST(Handover, OfTheSceneWaitsInAStopAndIsNotTold) {
  Lesson l;
  l.ticks(static_cast<int>(std::lround(l.scene.timeline[0].at * l.scene.tick_hz)) - 30 - static_cast<int>(l.session->session_tick()));
  ASSERT_EQ(l.told(kTrainee).handover, kComes);
  ASSERT_TRUE(l.session->stop_hands(l.now, AccessRole::kInstructor));
  l.ticks(2);
  EXPECT_EQ(l.told(kTrainee).handover, kNone);
}

TEST(Handover, InAStopMovesNobodysWeight) {
  Lesson l;
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(10);
  ASSERT_TRUE(l.session->stop_hands(l.now, AccessRole::kInstructor));
  l.ticks(1);
  EXPECT_TRUE(l.session->tool(0).authority.held()) << "a stop takes all weight at once";
  l.ticks(39);
  EXPECT_EQ(l.requested(), kToTrainee) << "on paper";
  EXPECT_EQ(l.alpha(kTrainee), 0);
  EXPECT_TRUE(l.session->tool(0).authority.held());
  ASSERT_TRUE(l.session->resume_hands(l.now, AccessRole::kInstructor, l.session->stops()));
  l.ticks(1000);
  EXPECT_EQ(l.alpha(kTrainee), 1) << "as it was decided before the stop";
}

TEST(Handover, OfTheSceneIsAnnouncedAheadAndBeginsAtItsTime) {
  Lesson l;
  ASSERT_EQ(l.scene.timeline.size(), 1u);
  const auto at = static_cast<std::uint32_t>(std::lround(l.scene.timeline[0].at * l.scene.tick_hz));
  l.ticks(static_cast<int>(at - 51 - l.session->session_tick()));
  EXPECT_EQ(l.decided(), kToTrainer);
  l.ticks(1);
  EXPECT_EQ(l.decided(), kToTrainee);
  EXPECT_EQ(l.told(kTrainee).handover, kComes);
  EXPECT_EQ(l.told(kTrainee).handover_ticks, 50u);
  l.ticks(49);
  EXPECT_EQ(l.requested(), kToTrainer);
  l.ticks(1);
  EXPECT_EQ(l.session->session_tick(), at);
  EXPECT_EQ(l.requested(), kToTrainee);
}

TEST(Handover, OfTheSceneIsPutOffUntilWhoGainsIsHeardFrom) {
  Lesson l;
  l.ticks(static_cast<int>(std::lround(l.scene.timeline[0].at * l.scene.tick_hz)) - 30 - static_cast<int>(l.session->session_tick()));
  l.ticks_without(kTrainee, 230);
  EXPECT_EQ(l.requested(), kToTrainer);
  EXPECT_EQ(l.alpha(kTrainer), 1) << "the tool is not left to nobody";
  EXPECT_EQ(l.noted(What::kAuthorityPutOff), 1) << "told once";
  EXPECT_EQ(l.decided(), kToTrainee);
  l.ticks(2000);
  EXPECT_EQ(l.requested(), kToTrainee);
  EXPECT_EQ(l.alpha(kTrainee), 1);
}

TEST(Handover, ThatIsDecidedIsInTheCheckpoint) {
  Lesson l;
  ASSERT_EQ(l.order(kToTrainee), Result::kDone);
  l.ticks(3);
  EXPECT_EQ(l.requested(), kToTrainer);
  EXPECT_EQ(l.session->checkpoint().tools[0].alpha, kToTrainee) << "after a restart nobody would say it again";
}

// What a seat asks for and nobody grants within a second is not wanted any more: it would come true much later, out of the blue.
TEST(Handover, AWishThatIsNotGrantedWithinASecondIsForgotten) {
  Lesson l;
  l.ticks_without(kTrainee, 300);
  ASSERT_TRUE(l.seats[kTrainer].core->request_authority(0, std::array{0.0, 1.0}));
  l.ticks_without(kTrainee, 1);
  EXPECT_EQ(l.told(kTrainer).handover, kCalledOff);
  l.ticks_without(kTrainee, 1100);
  EXPECT_LE(l.noted(What::kAuthorityRefused), 2);
  EXPECT_EQ(l.told(kTrainer).handover, kNone);
  l.ticks(2000);
  EXPECT_EQ(l.decided(), kToTrainer);
}

TEST(Handover, TakesNoHeap) {
  Lesson l;
  std::array<std::byte, link::kDatagramMax> buffer;
  for (int n = 0; n < 120; ++n) {
    for (std::size_t i = 0; i < l.seats.size(); ++i) {
      const auto sent = l.client_tick(i);
      const tandem::test::AllocGuard guard;
      for (const Bytes& d : sent) l.session->on_datagram(l.now, address(l.seats[i].at), d);
      EXPECT_EQ(guard.count(), 0u);
    }
    const tandem::test::AllocGuard guard;
    if (n % 7 == 0) static_cast<void>(l.order(n % 2 == 0 ? kToTrainee : kToTrainer));
    l.session->on_tick(l.now, 0);
    while (l.session->poll_transmit(l.now, buffer)) {}
    EXPECT_EQ(guard.count(), 0u);
    l.now += 1ms;
  }
}

/// The delay alone, tick by tick.
TEST(HandoverDelay, CarriesOutInOrderAndLetsTheLastDecisionBeTheLastToAct) {
  const auto change = [](double a) { return server::Handover::Change{.wanted = {a, 1 - a}}; };
  server::Handover h;
  h.begin_with({1, 0});
  h.decide({0.5, 0.5}, change(0.5), 50);
  h.tick();
  h.decide({0.25, 0.75}, change(0.25), 20);  // a scene's, which was known later and comes first: what comes after it is void
  std::vector<std::pair<int, double>> acted;
  for (int n = 2; n <= 120; ++n) {
    h.tick();
    if (const auto* due = h.due()) acted.emplace_back(n, due->wanted[0]);
    EXPECT_EQ(h.due(), nullptr) << "once";
  }
  EXPECT_EQ(acted, (std::vector<std::pair<int, double>>{{21, 0.25}}));
  h.decide({0, 1}, change(0), 0);
  ASSERT_NE(h.due(), nullptr) << "in this very tick";
  EXPECT_FALSE(h.pending());
}

}  // namespace
}  // namespace tandem::server
