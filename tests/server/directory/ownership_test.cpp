#include "server/directory/ownership.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/directory/model_store.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;

/// Servers over one store that answers at once.
class OwnershipTest : public testing::Test {
 protected:
  struct Server {
    Server(ModelStore& store, const std::string& name) : core(name, "text", LeaseTimes{}), directory(store) {}
    Ownership core;
    ModelDirectory directory;
    std::vector<Notice> notices;
    bool reaches_store = true, sees_changes = true;
  };
  Server& start(const std::string& name) {
    servers_.push_back(std::make_unique<Server>(store_, name));
    settle();
    return *servers_.back();
  }
  /// Servers "a", which owns session "s", and "b".
  std::pair<Server&, Server&> start_owner_and_other() {
    Server& owner = start("a");
    Server& other = start("b");
    owner.core.claim("s");
    settle();
    return {owner, other};
  }
  void settle() {
    store_.advance(now_);
    for (int round = 0; round < 10; ++round)
      for (const auto& server : servers_) {
        while (auto operation = server->core.poll_operation(now_))
          if (server->reaches_store) server->directory.begin(operation->id, operation->request);
        while (server->reaches_store) {
          auto reply = server->directory.poll();
          if (!reply) break;
          if (server->sees_changes || reply->changes.empty()) server->core.on_reply(now_, *reply);
        }
        while (auto notice = server->core.poll_notice()) server->notices.push_back(*notice);
      }
  }
  void pass(Duration time) {
    for (const Time end = now_ + time; now_ < end;) {
      now_ += 50ms;
      settle();
    }
  }
  static bool has(const Server& server, Notice::Kind kind, const std::string& other = {}) {
    return std::ranges::any_of(server.notices,
                               [&](const Notice& n) { return n.kind == kind && (other.empty() || n.other == other); });
  }
  SessionState state(const Server& server) { return server.core.state("s", now_); }

  ModelStore store_;
  std::vector<std::unique_ptr<Server>> servers_;
  Time now_{};
};

TEST_F(OwnershipTest, OwnsWhatItsTransactionCreated) {
  Server& a = start("a");
  Server& b = start("b");
  EXPECT_EQ(state(a), SessionState::kNone);
  ASSERT_TRUE(a.core.claim("s"));
  settle();
  EXPECT_EQ(state(a), SessionState::kServing);
  EXPECT_EQ(a.core.revision("s"), store_.entries().at("/tandem/v1/live/sessions/s/owner").created);
  EXPECT_TRUE(a.core.may_act("s", now_));
  ASSERT_TRUE(b.core.claim("s"));
  settle();
  EXPECT_TRUE(has(b, Notice::Kind::kElsewhere, "a"));
  EXPECT_EQ(state(b), SessionState::kNone);
  EXPECT_FALSE(b.core.claim("bad/name"));
}

TEST_F(OwnershipTest, HoldsAfterTwoThirdsAndServesAgainWhenTheLeaseStood) {
  Server& a = start("a");
  a.core.claim("s");
  settle();
  a.reaches_store = false;
  const Time last = a.core.keeper().hold_at() - 2s;
  now_ = last + 2s - 1ns;
  EXPECT_EQ(state(a), SessionState::kServing);
  now_ = last + 2s;
  EXPECT_EQ(state(a), SessionState::kHolding);
  EXPECT_TRUE(a.core.may_act("s", now_));  // ramps out
  now_ = last + 2200ms;
  EXPECT_FALSE(a.core.may_act("s", now_));
  a.reaches_store = true;
  now_ = last + 2900ms;
  settle();
  pass(1s);
  EXPECT_EQ(state(a), SessionState::kServing);
}

TEST_F(OwnershipTest, LosesItsSessionsWithTheLeaseAndAnyServerTakesOverOnRequestOnly) {
  const auto [a, b] = start_owner_and_other();
  const Revision first = a.core.revision("s");
  a.reaches_store = false;
  pass(5s);
  EXPECT_EQ(state(b), SessionState::kNone);  // a missing key is no reason to claim
  EXPECT_TRUE(store_.entries().contains("/tandem/v1/live/servers/b"));
  b.core.claim("s");
  settle();
  EXPECT_EQ(state(b), SessionState::kServing);
  EXPECT_GT(b.core.revision("s"), first);
  EXPECT_EQ(state(a), SessionState::kHolding);
  a.reaches_store = true;
  pass(2s);
  EXPECT_EQ(state(a), SessionState::kLost);
  EXPECT_TRUE(has(a, Notice::Kind::kLeaseLost));
  a.core.forget("s");
  EXPECT_EQ(state(a), SessionState::kNone);
}

TEST_F(OwnershipTest, AStandbyTakesOverByItselfAndBeforeOthers) {
  Server& a = start("a");
  Server& b = start("b");
  Server& c = start("c");
  a.core.claim("s");
  settle();
  EXPECT_FALSE(a.core.set_standby("s", "a"));
  ASSERT_TRUE(a.core.set_standby("s", "b"));
  settle();
  EXPECT_TRUE(has(a, Notice::Kind::kStandbySet, "b"));
  a.reaches_store = false;
  b.reaches_store = false;  // b's lease goes on: it is cut off for a moment only
  pass(1s);
  b.reaches_store = true;
  for (int n = 0; n < 40 && state(b) != SessionState::kServing; ++n) {
    c.core.claim("s");
    pass(100ms);
    EXPECT_NE(state(c), SessionState::kServing);
  }
  EXPECT_EQ(state(b), SessionState::kServing);
  EXPECT_FALSE(store_.entries().contains("/tandem/v1/live/sessions/s/standby"));
}

/// A full store refuses each request, and those for all sessions would pile up until no renewal gets through.
TEST_F(OwnershipTest, AsksForOneStandbyAtATimeAndThenForTheNewest) {
  const auto [a, b] = start_owner_and_other();
  Server& c = start("c");
  const auto asked = [&, &a = a] {
    std::vector<Ownership::Operation> begun;
    while (auto operation = a.core.poll_operation(now_)) {
      const auto* const wanted = std::get_if<Transaction>(&operation->request);
      const auto* const put = wanted && !wanted->then.empty() ? std::get_if<Put>(&wanted->then[0]) : nullptr;
      if (put && put->key.ends_with("/standby")) begun.push_back(std::move(*operation));
    }
    return begun;
  };
  std::size_t requests = 0;
  for (int n = 0; n < 100; ++n, now_ += 10ms) {
    EXPECT_TRUE(a.core.set_standby("s", "b"));
    const auto open = asked();
    ASSERT_LE(open.size(), 1U);
    for (const auto& operation : open) {
      ++requests;
      Reply full;
      full.operation = operation.id;
      full.outcome = Outcome::kUnknown;
      a.core.on_reply(now_, full);
    }
  }
  EXPECT_LE(requests, 2U) << "once a second";
  pass(2s);
  EXPECT_TRUE(has(a, Notice::Kind::kStandbySet, "b"));
  const auto answer = [&, &a = a](const Ownership::Operation& operation) {
    a.core.on_reply(now_, store_.execute(operation.id, operation.request));
  };
  EXPECT_TRUE(a.core.set_standby("s", "b"));
  auto open = asked();
  ASSERT_EQ(open.size(), 1U);
  EXPECT_TRUE(a.core.set_standby("s", "c"));
  EXPECT_TRUE(asked().empty());
  answer(open[0]);
  open = asked();
  ASSERT_EQ(open.size(), 1U);
  EXPECT_TRUE(a.core.move("s", "b"));
  EXPECT_FALSE(a.core.set_standby("s", "c")) << "it moves to b";
  answer(open[0]);
  EXPECT_EQ(store_.entries().at("/tandem/v1/live/sessions/s/standby").value, "c");
  pass(1s);
  EXPECT_EQ(state(c), SessionState::kNone);
  EXPECT_EQ(state(b), SessionState::kServing);
}

TEST_F(OwnershipTest, ADeadStandbyDelaysNoClaim) {
  Server& a = start("a");
  Server& b = start("b");
  Server& c = start("c");
  a.core.claim("s");
  settle();
  a.core.set_standby("s", "b");
  settle();
  a.reaches_store = b.reaches_store = false;
  pass(4s);
  c.core.claim("s");
  settle();
  EXPECT_EQ(state(c), SessionState::kServing);
}

TEST_F(OwnershipTest, AnOldViewDelaysNoClaim) {
  const auto [a, b] = start_owner_and_other();
  a.core.set_standby("s", "b");
  settle();
  b.sees_changes = false;
  a.reaches_store = false;
  const DirectoryKeys keys;
  (void)store_.execute(9999, Transaction{{}, {Erase{keys.owner("s")}, Erase{keys.standby("s")}}, {}});
  ASSERT_TRUE(b.core.view().session("s")->standby);  // which is no longer true
  b.core.claim("s");
  pass(200ms);
  EXPECT_EQ(state(b), SessionState::kServing);
}

TEST_F(OwnershipTest, AMoveRampsOutBeforeTheTargetBegins) {
  const auto [a, b] = start_owner_and_other();
  ASSERT_TRUE(a.core.move("s", "b"));
  settle();
  EXPECT_EQ(state(a), SessionState::kHolding);
  EXPECT_TRUE(a.core.may_act("s", now_));
  EXPECT_EQ(state(b), SessionState::kNone);
  now_ += 200ms;
  settle();
  EXPECT_FALSE(a.core.may_act("s", now_));
  EXPECT_TRUE(has(a, Notice::Kind::kReleased));
  EXPECT_EQ(state(b), SessionState::kServing);
  EXPECT_FALSE(a.core.move("s", "b"));
  b.core.move("s", "not-there");
  settle();
  EXPECT_TRUE(has(b, Notice::Kind::kStandbyRefused, "not-there"));
  EXPECT_EQ(state(b), SessionState::kServing);
}

TEST_F(OwnershipTest, AnEndedSessionLeavesNoKey) {
  const auto [a, b] = start_owner_and_other();
  a.core.set_standby("s", "b");
  settle();
  ASSERT_TRUE(a.core.release(now_, "s"));
  pass(1s);
  EXPECT_EQ(state(a), SessionState::kNone);
  EXPECT_EQ(state(b), SessionState::kNone);
  for (const auto& [key, entry] : store_.entries()) EXPECT_EQ(key.find("sessions"), std::string::npos) << key;
}

// The claim is answered "a owns it" after the view has told that a has handed the session over.
TEST_F(OwnershipTest, TakesASessionThatIsHandedOverWhileItsClaimIsRefused) {
  const auto [a, b] = start_owner_and_other();
  ASSERT_TRUE(b.core.claim("s"));
  const auto claim = b.core.poll_operation(now_);
  ASSERT_TRUE(claim);
  const Reply refused = store_.execute(9999, claim->request);
  ASSERT_FALSE(refused.held);
  ASSERT_TRUE(a.core.move("s", "b"));
  pass(500ms);
  ASSERT_EQ(state(a), SessionState::kNone);
  Reply late = refused;
  late.operation = claim->id;
  b.core.on_reply(now_, late);
  pass(200ms);
  EXPECT_EQ(state(b), SessionState::kServing);
}

TEST_F(OwnershipTest, SendsNoClaimWhileClaimsAreHeld) {
  Server& a = start("a");
  Server& b = start("b");
  b.core.hold_claims(true);
  a.core.claim("s");
  ASSERT_TRUE(b.core.claim("t"));
  settle();
  ASSERT_TRUE(a.core.move("s", "b"));  // b takes it over by itself, not before it may
  pass(1s);
  EXPECT_EQ(b.core.state("t", now_), SessionState::kClaiming);
  EXPECT_EQ(state(b), SessionState::kClaiming);
  b.core.hold_claims(false);
  pass(100ms);
  EXPECT_EQ(b.core.state("t", now_), SessionState::kServing);
  EXPECT_EQ(state(b), SessionState::kServing);
}

// The lease stands, and so does a key of an earlier ownership of another server.
TEST_F(OwnershipTest, LosesASessionWhoseKeyIsAnOlderOneInAStoreThatWasPutBack) {
  const auto [a, b] = start_owner_and_other();
  const ModelStore copy = store_;
  ASSERT_TRUE(a.core.move("s", "b"));
  pass(1s);
  ASSERT_EQ(state(b), SessionState::kServing);
  store_ = copy;
  store_.resume(now_, 1000);
  for (int n = 0; n < 100; ++n)  // revisions go on beyond those that b knows
    (void)store_.execute(9999, Transaction{{}, {Put{"/other", "x", 0}}, {}});
  (void)store_.execute(9999, Compact{store_.revision()});  // all read again
  pass(200ms);
  EXPECT_EQ(state(b), SessionState::kLost);
  EXPECT_EQ(state(a), SessionState::kServing);
}

TEST_F(OwnershipTest, UsesATicketOnceInTheWholeServiceAndOnlyForItsOwnSession) {
  Server& a = start("a");
  Server& b = start("b");
  a.core.claim("s");
  b.core.claim("t");
  settle();
  EXPECT_TRUE(a.core.use_ticket("s", "1"));
  EXPECT_FALSE(b.core.use_ticket("s", "1"));
  settle();
  EXPECT_TRUE(has(a, Notice::Kind::kTicketAccepted, "1"));
  EXPECT_TRUE(b.core.use_ticket("t", "1"));
  EXPECT_TRUE(a.core.use_ticket("s", "1"));
  settle();
  EXPECT_TRUE(has(b, Notice::Kind::kTicketRefused, "1"));
  EXPECT_TRUE(has(a, Notice::Kind::kTicketRefused, "1"));
  // A server that has lost its session burns no ticket.
  (void)store_.execute(9999, Transaction{{}, {Erase{"/tandem/v1/live/sessions/s/owner"}}, {}});
  EXPECT_TRUE(a.core.use_ticket("s", "2"));
  settle();
  EXPECT_FALSE(store_.entries().contains("/tandem/v1/tickets/2"));
  EXPECT_TRUE(has(a, Notice::Kind::kTicketUnanswered, "2"));
  EXPECT_FALSE(has(a, Notice::Kind::kTicketRefused, "2"));
}

/// A console was joined by its ticket at an owner that has died.
TEST_F(OwnershipTest, UsesATicketAgainInThePlaceOfItsUseAtAFormerOwnerAndOnce) {
  Server& a = start("a");
  a.core.claim("s");
  settle();
  (void)store_.execute(9999, Transaction{{}, {Put{"/tandem/v1/tickets/1", "former/1/1", 0}}, {}});
  EXPECT_TRUE(a.core.use_ticket("s", "1"));
  settle();
  EXPECT_TRUE(has(a, Notice::Kind::kTicketRefused, "1"));
  a.notices.clear();
  EXPECT_TRUE(a.core.use_ticket("s", "1", 0, true));
  pass(500ms);
  EXPECT_TRUE(has(a, Notice::Kind::kTicketAccepted, "1"));
  EXPECT_FALSE(has(a, Notice::Kind::kTicketRefused, "1"));
  EXPECT_TRUE(store_.entries().at("/tandem/v1/tickets/1").value.starts_with("a/"));
  a.notices.clear();
  EXPECT_TRUE(a.core.use_ticket("s", "1"));
  settle();
  EXPECT_TRUE(has(a, Notice::Kind::kTicketRefused, "1"));
  // A ticket that was not used, or that its former owner made valid again.
  EXPECT_TRUE(a.core.use_ticket("s", "2", 0, true));
  pass(500ms);
  EXPECT_TRUE(has(a, Notice::Kind::kTicketAccepted, "2"));
  // A server that has lost the session takes no use over.
  (void)store_.execute(9998, Transaction{{}, {Put{"/tandem/v1/tickets/3", "former/1/3", 0}}, {}});
  (void)store_.execute(9999, Transaction{{}, {Erase{"/tandem/v1/live/sessions/s/owner"}}, {}});
  EXPECT_TRUE(a.core.use_ticket("s", "3", 0, true));
  pass(500ms);
  EXPECT_EQ(store_.entries().at("/tandem/v1/tickets/3").value, "former/1/3");
}

TEST_F(OwnershipTest, LosesASessionWhoseKeyAnOperatorErased) {
  Server& a = start("a");
  a.core.claim("s");
  settle();
  (void)store_.execute(9999, Transaction{{}, {Erase{"/tandem/v1/live/sessions/s/owner"}}, {}});
  settle();
  EXPECT_EQ(state(a), SessionState::kLost);
  EXPECT_FALSE(a.core.may_act("s", now_));
}

TEST_F(OwnershipTest, BoundsItsSessionsAndTickets) {
  Server& a = start("a");
  for (std::size_t n = 0; n < Ownership::kSessionsMax; ++n) EXPECT_TRUE(a.core.claim("x" + std::to_string(n)));
  EXPECT_FALSE(a.core.claim("more"));
  settle();
  std::size_t taken = 0;
  while (taken < 5000 && a.core.use_ticket("x0", std::to_string(taken))) ++taken;
  EXPECT_EQ(taken, Ownership::kTicketsMax);
  settle();
  EXPECT_TRUE(a.core.use_ticket("x0", "later"));
}

}  // namespace
}  // namespace tandem::directory
