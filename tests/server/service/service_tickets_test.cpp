#include "server/service/service_tickets.h"

#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

using Outcome = ServiceTickets::Outcome;

class ServiceTicketsTest : public ServiceTest {
 protected:
  void use(Server& server, const std::string& session, const std::string& ticket, std::uint64_t order,
           bool again = false) {
    server.member.tickets().use(now_, session, ticket, 2h, order, again);
  }
  std::map<std::uint64_t, Outcome> results(Server& server) {
    std::map<std::uint64_t, Outcome> all;
    while (const auto result = server.member.tickets().poll_result())
      EXPECT_TRUE(all.emplace(result->order, result->outcome).second);
    return all;
  }
  /// Two servers, each with a session.
  void start_two() {
    a = &start("a", {{"lab", session_spec(1)}});
    b = &start("b", {{"two", session_spec(2)}});
    ASSERT_TRUE(a->open.contains("lab") && b->open.contains("two"));
  }
  Server *a = nullptr, *b = nullptr;
};

TEST_F(ServiceTicketsTest, EachTicketIsAcceptedOnceInTheWholeService) {
  start_two();
  use(*a, "lab", "t1", 1);
  use(*b, "two", "t1", 2);
  pass(500ms);
  const auto one = results(*a), two = results(*b);
  ASSERT_EQ(one.size() + two.size(), 2u);
  EXPECT_NE(one.at(1) == Outcome::kAccepted, two.at(2) == Outcome::kAccepted);
  use(*a, "lab", "t1", 3);
  pass(500ms);
  EXPECT_EQ(results(*a).at(3), Outcome::kUsed);
}

TEST_F(ServiceTicketsTest, StaysUsedAfterATakeover) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(3s);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
  a->runs = false;
  a->open.clear();
  pass(5s);
  ASSERT_TRUE(b->open.contains("lab"));
  use(*b, "lab", "t1", 2);
  pass(500ms);
  EXPECT_EQ(results(*b).at(2), Outcome::kUsed);
}

TEST_F(ServiceTicketsTest, OfAConsoleIsAcceptedAgainAfterATakeoverAndOnce) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(3s);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
  a->runs = false;
  a->open.clear();
  pass(5s);
  ASSERT_TRUE(b->open.contains("lab"));
  use(*b, "lab", "t1", 2, true);
  pass(500ms);
  EXPECT_EQ(results(*b).at(2), Outcome::kAccepted);
  use(*b, "two", "t1", 3);
  pass(500ms);
  EXPECT_EQ(results(*b).at(3), Outcome::kUsed);
  // It can be restored like any other that this server has used.
  b->member.tickets().restore("lab", "t1");
  pass(500ms);
  EXPECT_FALSE(has("tickets/t1"));
}

/// A console that had no effect leaves, and comes at once with the same ticket.
TEST_F(ServiceTicketsTest, UseWaitsForTheRestoreOfTheSameTicket) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
  a->member.tickets().restore("lab", "t1");
  use(*a, "lab", "t1", 2);
  pass(1s);
  EXPECT_EQ(results(*a).at(2), Outcome::kAccepted);
  EXPECT_TRUE(has("tickets/t1")) << "the restore must not erase the new use";
}

TEST_F(ServiceTicketsTest, RestoredTicketIsValidAgainEverywhere) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
  a->member.tickets().restore("lab", "t1");
  pass(500ms);
  use(*b, "two", "t1", 2);
  pass(500ms);
  EXPECT_EQ(results(*b).at(2), Outcome::kAccepted);
}

TEST_F(ServiceTicketsTest, RestoreLeavesTheUseOfAnotherServer) {
  start_two();
  use(*b, "two", "t1", 1);
  pass(500ms);
  use(*a, "lab", "t1", 2);
  pass(500ms);
  EXPECT_EQ(results(*a).at(2), Outcome::kUsed);
  a->member.tickets().restore("lab", "t1");
  pass(500ms);
  EXPECT_TRUE(has("tickets/t1"));
}

// The restore is executed twice, because its first answer is lost. Another server has used the ticket in between.
TEST_F(ServiceTicketsTest, RestoreThatIsSentAgainLeavesALaterUse) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
  a->directory.answers_lost = true;
  a->member.tickets().restore("lab", "t1");
  pass(100ms);
  ASSERT_FALSE(has("tickets/t1"));
  use(*b, "two", "t1", 2);
  pass(200ms);
  ASSERT_EQ(results(*b).at(2), Outcome::kAccepted);
  a->directory.answers_lost = false;
  pass(4s);
  EXPECT_TRUE(a->member.all_written());  // it was sent again
  EXPECT_TRUE(has("tickets/t1"));
}

TEST_F(ServiceTicketsTest, TicketWithoutAnAnswerIsReportedAndStaysValid) {
  start_two();
  a->directory.answers_lost = true;
  use(*a, "lab", "t1", 1);
  pass(3100ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kNoAnswer);
  a->directory.answers_lost = false;
  pass(8s);  // sessions may have moved meanwhile
  Server& owner = a->open.contains("two") ? *a : *b;
  use(owner, "two", "t1", 2);
  pass(1s);
  EXPECT_EQ(results(owner).at(2), Outcome::kAccepted);
}

/// The session is lost while the use waits. Its next owner may be this server.
TEST_F(ServiceTicketsTest, IsNotRefusedAsUsedByAServerThatLostTheSession) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted) << "the lease for uses is there";
  a->directory.cut = true;
  pass(4s);
  use(*a, "lab", "t2", 2);
  pass(100ms);
  a->directory.cut = false;
  pass(1s);
  EXPECT_EQ(results(*a).at(2), Outcome::kNoAnswer);
  EXPECT_FALSE(has("tickets/t2"));
  use(*a, "lab", "t3", 3);
  EXPECT_EQ(results(*a).at(3), Outcome::kNoAnswer) << "of another server";
}

TEST_F(ServiceTicketsTest, IsNotRefusedAsUsedWhenTheLeaseForItsUseIsGone) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  const auto lease = store_.entries().at("/tandem/v1/tickets/t1").lease;
  static_cast<void>(store_.execute(1, directory::Revoke{lease}));
  use(*a, "lab", "t2", 2);
  pass(500ms);
  EXPECT_EQ(results(*a).at(2), Outcome::kNoAnswer);
  use(*a, "lab", "t2", 3);
  pass(500ms);
  EXPECT_EQ(results(*a).at(3), Outcome::kAccepted) << "under a new lease";
}

TEST_F(ServiceTicketsTest, RefusedTicketsLeaveNoLeases) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  const std::size_t leases = store_.leases();
  for (std::uint64_t n = 2; n < 12; ++n) {
    use(*a, "lab", "t1", n);
    pass(500ms);
    EXPECT_EQ(results(*a).at(n), Outcome::kUsed);
  }
  EXPECT_EQ(store_.leases(), leases);
}

/// Otherwise a full directory, which grants none, would be asked for one as fast as it answers.
TEST_F(ServiceTicketsTest, LeaseIsAskedForWithPausesWhileItIsNotGranted) {
  start_two();
  ServiceTickets& tickets = a->member.tickets();
  use(*a, "lab", "t1", 1);
  int asked = 0;
  for (directory::OperationId operation = 1; operation <= 100; ++operation, now_ += 10ms) {
    if (!tickets.poll_request(now_, operation, 2s)) continue;
    ++asked;
    directory::Reply full;
    full.operation = operation;
    full.outcome = directory::Outcome::kUnknown;
    EXPECT_TRUE(tickets.on_reply(full));
  }
  EXPECT_EQ(asked, 10);
  pass(500ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
}

TEST_F(ServiceTicketsTest, DirectoryForgetsTheUseAfterTheTicketEndedAndNotBefore) {
  start_two();
  use(*a, "lab", "t1", 1);
  pass(500ms);
  EXPECT_EQ(results(*a).at(1), Outcome::kAccepted);
  EXPECT_TRUE(has("tickets/t1"));
  // Both servers end; the store alone counts.
  a->runs = b->runs = false;
  now_ += 2h;
  store_.advance(now_);
  EXPECT_TRUE(has("tickets/t1"));
  now_ += 2h;
  store_.advance(now_);
  EXPECT_FALSE(has("tickets/t1"));
}

TEST_F(ServiceTicketsTest, RefusesTicketsForSessionsOfOtherServersAndBeyondItsQueue) {
  start_two();
  use(*a, "two", "t1", 1);
  for (std::uint64_t n = 0; n <= ServiceTickets::kWaitingMax; ++n) use(*a, "lab", "x" + std::to_string(n), 100 + n);
  pass(2s);
  const auto all = results(*a);
  EXPECT_EQ(all.at(1), Outcome::kNoAnswer);
  EXPECT_EQ(all.at(100), Outcome::kAccepted);
  EXPECT_EQ(all.at(100 + ServiceTickets::kWaitingMax), Outcome::kNoAnswer);
  EXPECT_EQ(all.size(), ServiceTickets::kWaitingMax + 2);
}

}  // namespace
}  // namespace tandem::server::test
