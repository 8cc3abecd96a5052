// Moves that meet an end of the session, a full directory, or the loss of their target. In virtual time.
#include "server/service/session_moves.h"
#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

class ServiceMoves : public ServiceTest {
 protected:
  /// The main loop of a server stands still, and its member goes on.
  void pass_without_main_loop(Server& a, Duration time) {
    a.runs = false;
    for (const Time end = now_ + time; now_ < end;) {
      pass(20ms);
      a.member.step(now_);
    }
  }
  /// The same until an order waits for the main loop.
  void until_ordered(Server& a) {
    for (int n = 0; n < 100 && !a.member.sessions().has_event(); ++n) pass_without_main_loop(a, 20ms);
    ASSERT_TRUE(a.member.sessions().has_event());
  }
  /// The session ends before its server has begun the hand-over, which it then leaves out.
  void ignore_order(Server& a) {
    const auto event = a.member.sessions().poll_event();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, ServiceEvent::Kind::kHandOver);
    a.runs = true;
  }
};

TEST_F(ServiceMoves, SessionThatEndsBeforeItsHandOverBeginsEndsInTheDirectoryToo) {
  Server& a = start("a", {{"lab", session_spec(1)}, {"other", session_spec(2)}});
  Server& b = start("b");
  pass(3s);
  order_move("lab", "b");
  until_ordered(a);
  a.member.sessions().end("lab");
  ignore_order(a);
  pass(3s);
  EXPECT_FALSE(has("catalogue/lab/spec"));
  EXPECT_FALSE(has("live/sessions/lab/owner"));
  EXPECT_FALSE(b.open.contains("lab"));
  order_move("other", "b");
  pass(2s);
  EXPECT_TRUE(b.open.contains("other")) << "the next session moves";
}

TEST_F(ServiceMoves, SessionThatEndsBeforeItsHandOverBeginsIsReplaced) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  start("b");
  pass(3s);
  order_move("lab", "b");
  until_ordered(a);
  a.member.sessions().replace("lab", session_spec(2));
  ignore_order(a);
  pass(3s);
  ASSERT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.open["lab"].spec.id[0], std::byte{2});
}

TEST_F(ServiceMoves, SessionThatIsHandedOverIsNotEnded) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  order_move("lab", "b");
  on_hand_over = [&](Server&) { a.member.moves().on_handed_over(now_, "lab"); };
  until_ordered(a);
  act(a);
  a.member.sessions().end("lab");
  a.runs = true;
  pass(3s);
  EXPECT_TRUE(b.open.contains("lab"));
}

/// Its hands must not act by a newer lease until the server has given it up.
TEST_F(ServiceMoves, SessionThatIsLostBeforeItsHandOverBeginsIsGivenUp) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  order_move("lab", "b");
  until_ordered(a);
  a.directory.cut = true;
  pass(6s);
  a.directory.cut = false;
  pass_without_main_loop(a, 3s);
  ASSERT_TRUE(b.open.contains("lab"));
  EXPECT_GT(a.member.act_until(), now_) << "it has a lease again";
  EXPECT_FALSE(a.member.served_until());
  act(a);
  EXPECT_EQ(a.events.back().kind, ServiceEvent::Kind::kGiveUp);
  EXPECT_EQ(a.member.served_until(), a.member.act_until());
}

TEST_F(ServiceMoves, HandsActOnWhileASessionOpens) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  pass(3s);
  ASSERT_TRUE(a.member.create(now_, "exam", session_spec(2), 7));
  until_ordered(a);
  EXPECT_EQ(a.member.served_until(), a.member.act_until());
}

/// Otherwise a lesson that runs would be without a server until etcd has space.
TEST_F(ServiceMoves, NoneBeginsWhileTheDirectoryStoresNoSnapshots) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  a.directory.full = true;
  a.member.sessions().set_snapshot("lab", "newer");
  pass(1s);
  ASSERT_NE(a.member.storage_problem(), "");
  order_move("lab", "b");
  pass(20s);
  EXPECT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.member.status(now_).moves, 0U);
  a.directory.full = false;
  pass(3s);
  EXPECT_TRUE(b.open.contains("lab")) << "the order is carried out then";
  EXPECT_EQ(b.open["lab"].snapshot, "state at the hand-over");
}

TEST_F(ServiceMoves, SessionWhoseLastSnapshotIsNotStoredComesBack) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  on_hand_over = [](Server& server) { server.directory.full = true; };
  order_move("lab", "b");
  pass(2s);
  ASSERT_FALSE(a.open.contains("lab")) << "it is handed over";
  pass(5s);
  ASSERT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.open["lab"].snapshot, "state at the hand-over") << "the directory has an older one";
  EXPECT_FALSE(b.open.contains("lab"));
}

/// A problem must not outlive the value that could not be stored.
TEST_F(ServiceMoves, BeginAgainWhenTheSessionThatCouldNotBeStoredIsOver) {
  Server& a = start("a", {{"lab", session_spec(1)}, {"other", session_spec(2)}});
  Server& b = start("b");
  pass(3s);
  a.directory.full = true;
  a.member.sessions().set_snapshot("other", "newer");
  pass(1s);
  ASSERT_NE(a.member.storage_problem(), "");
  a.member.end("other");
  a.open.erase("other");
  EXPECT_EQ(a.member.storage_problem(), "");
  a.directory.full = false;
  order_move("lab", "b");
  pass(3s);
  EXPECT_TRUE(b.open.contains("lab"));
}

/// Its main loop is so late that the session is its own again before it has given up the run that it lost.
TEST_F(ServiceMoves, SessionThatComesBackBeforeItWasGivenUpDoesNotAct) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  a.directory.cut = true;
  pass_without_main_loop(a, 6s);
  ASSERT_TRUE(b.open.contains("lab"));
  a.directory.cut = false;
  pass_without_main_loop(a, 3s);
  order_move("lab", "a");
  pass_without_main_loop(a, 3s);
  ASSERT_FALSE(b.open.contains("lab"));
  EXPECT_GT(a.member.act_until(), now_);
  EXPECT_FALSE(a.member.served_until()) << "the run of before is not over";
  act(a);
  EXPECT_EQ(a.member.served_until(), a.member.act_until());
  EXPECT_EQ(a.open["lab"].snapshot, "state at the hand-over") << "of b";
}

/// The client of a ticket that etcd confirms during the move joins at the next owner, with the same ticket.
TEST_F(ServiceMoves, WaitForTheUseOfATicketSoThatItCanBeRestored) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  on_hand_over = [&](Server& server) {
    server.directory.grants_nothing = true;  // the use needs a lease
    server.member.tickets().use(now_, "lab", "0123", 1h, 5);
  };
  order_move("lab", "b");
  pass(1s);
  ASSERT_FALSE(a.open.contains("lab"));
  EXPECT_TRUE(a.member.tickets().uses_wait("lab"));
  EXPECT_EQ(a.member.directory().ownership.view().session("lab")->owner->name, "a");
  a.directory.grants_nothing = false;
  for (int n = 0; n < 200 && a.member.tickets().uses_wait("lab"); ++n) pass(20ms);
  EXPECT_TRUE(has("tickets/0123"));
  a.member.tickets().restore("lab", "0123");
  pass(3s);
  EXPECT_TRUE(b.open.contains("lab"));
  EXPECT_FALSE(has("tickets/0123"));
}

TEST_F(ServiceMoves, ServerLeavesOnlyWhenTheEndsOfItsSessionsAreStored) {
  Server& a = start("a", {{"lab", session_spec(1)}, {"other", session_spec(2)}});
  pass(1s);
  a.directory.answers_lost = true;
  a.member.end("lab");
  a.member.replace("other", session_spec(3));
  a.open.clear();
  pass(100ms);
  EXPECT_FALSE(a.member.all_written()) << "the next client would begin the ended session again";
  a.directory.answers_lost = false;
  pass(3s);
  EXPECT_TRUE(a.member.all_written());
  EXPECT_FALSE(has("catalogue/lab/spec"));
}

/// A standby may be gone at the moment of a move to another server.
TEST_F(ServiceMoves, GoOnWhenAnotherServerIsRefusedAsStandby) {
  Server& a = start("a", {{"lab", session_spec(1)}});
  Server& b = start("b");
  pass(3s);
  on_hand_over = [&](Server&) { a.member.moves().on_standby_refused(now_, "lab", "c"); };
  order_move("lab", "b");
  pass(2s);
  EXPECT_TRUE(b.open.contains("lab"));
  EXPECT_EQ(std::ranges::count(a.events, ServiceEvent::Kind::kOpen, &ServiceEvent::kind), 1);
}

/// A zone that was gone for a moment must not stay without standbys.
TEST_F(ServiceMoves, StandbyIsInTheOtherZoneAgainWhenThatIsBack) {
  start("a", {{"lab", session_spec(1)}}, "east");
  start("b", {}, "east");
  Server& c = start("c", {}, "west");
  pass(2s);
  ASSERT_EQ(value("live/sessions/lab/standby"), "c");
  c.runs = false;
  pass(8s);
  ASSERT_EQ(value("live/sessions/lab/standby"), "b");
  c.runs = true;
  pass(5s);
  EXPECT_EQ(value("live/sessions/lab/standby"), "c");
}

TEST_F(ServiceMoves, StandbyThatDrainsIsReplaced) {
  start("a", {{"lab", session_spec(1)}}, "east");
  Server& b = start("b", {}, "west");
  pass(2s);
  ASSERT_EQ(value("live/sessions/lab/standby"), "b");
  b.member.describe({.address = "b:7000", .key = "k", .version = "1", .zone = "west", .capacity = 4, .drains = true});
  pass(3s);
  EXPECT_EQ(value("live/sessions/lab/standby"), "b") << "there is no other one";
  start("c", {}, "east");
  pass(3s);
  EXPECT_EQ(value("live/sessions/lab/standby"), "c");
}

/// Of a later release, or damaged: another server of the service may read it.
TEST_F(ServiceMoves, SpecThatCannotBeReadStaysInTheDirectory) {
  const std::map<std::string, ServiceSession> configured{{"lab", session_spec(1)}};
  start("a", configured);
  Server& b = start("b", configured);
  pass(3s);
  static_cast<void>(
      store_.execute(0, directory::Transaction{{}, {directory::Put{"/tandem/v1/catalogue/lab/spec", "{}", 0}}, {}}));
  order_move("lab", "b");
  pass(30s);
  EXPECT_FALSE(b.open.contains("lab"));
  EXPECT_EQ(value("catalogue/lab/spec"), "{}");
  EXPECT_EQ(value("snapshots/lab"), "state at the hand-over");
  ASSERT_FALSE(b.events.empty());
  EXPECT_EQ(b.events.back().kind, ServiceEvent::Kind::kUnreadable);
  EXPECT_LE(std::ranges::count(b.events, ServiceEvent::Kind::kUnreadable, &ServiceEvent::kind), 4) << "every 10 s";
}

}  // namespace
}  // namespace tandem::server::test
