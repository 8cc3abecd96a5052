// Sessions of a service move to less used servers by themselves.
#include <set>
#include <utility>

#include "proto/rpc/rpc_limits.h"
#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

class ServiceBalance : public ServiceTest {
 protected:
  /// Lets time pass in which all servers report their loads each second: each session expects 0.1 cores.
  void pass_with_loads(Duration time) {
    for (const Time end = now_ + time; now_ < end;) {
      for (const auto& server : servers_) {
        if (!server->runs) continue;
        std::vector<SessionLoad> loads;
        for (const auto& [session, event] : server->open)
          loads.push_back({session, cost, 0.1, !people.contains(session)});
        const auto sum = static_cast<double>(loads.size());
        server->member.moves().set_loads(loads);
        server->member.describe({.address = "s:7000",
                                 .key = "k",
                                 .version = "1",
                                 .zone = "",
                                 .capacity = capacity,
                                 .used = sum * cost,
                                 .drains = draining.contains(server.get()),
                                 .expected = sum * 0.1});
      }
      pass(1s);
    }
  }
  std::vector<std::size_t> counts() const {
    std::vector<std::size_t> counts;
    for (const auto& server : servers_) counts.push_back(server->open.size());
    return counts;
  }
  static std::map<std::string, ServiceSession> sessions(int count) {
    std::map<std::string, ServiceSession> sessions;
    for (int n = 1; n <= count; ++n) sessions["s" + std::to_string(n)] = session_spec(n);
    return sessions;
  }

  std::set<std::string> people;  ///< sessions with people
  std::set<const Server*> draining;
  double cost = 0.001, capacity = 4;
};

TEST_F(ServiceBalance, ServersThatComeLaterGetTheirPartOfTheSessionsThatWait) {
  start("a", sessions(6));
  start("b", sessions(6));
  start("c", sessions(6));
  ASSERT_EQ(counts(), (std::vector<std::size_t>{6, 0, 0}));
  pass_with_loads(30s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 2, 2}));
  for (const ServiceEvent& event : servers_[1]->events) {
    if (event.kind != ServiceEvent::Kind::kOpen) continue;
    EXPECT_EQ(event.snapshot, "state at the hand-over");
  }
  const auto moves = servers_[0]->member.status(now_).moves;
  EXPECT_EQ(moves, 4U);
  pass_with_loads(120s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 2, 2}));
  EXPECT_EQ(servers_[0]->member.status(now_).moves, moves) << "they rest";
}

TEST_F(ServiceBalance, ServerThatReturnsGetsItsPartBack) {
  start("a", sessions(4));
  start("b", sessions(4));
  pass_with_loads(20s);
  ASSERT_EQ(counts(), (std::vector<std::size_t>{2, 2}));
  servers_[0]->runs = false;
  servers_[0]->open.clear();
  pass_with_loads(10s);
  ASSERT_EQ(servers_[1]->open.size(), 4U);
  start("c", sessions(4));
  pass_with_loads(20s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{0, 2, 2}));
}

TEST_F(ServiceBalance, PeopleStayWhereTheyAreUnlessTheirServerIsBusy) {
  start("a", sessions(6));
  start("b");
  people = {"s1", "s2", "s3", "s4", "s5", "s6"};
  pass_with_loads(120s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{6, 0}));
  cost = 0.1;  // six of them use 0.6 of a capacity of 1
  capacity = 1;
  pass_with_loads(120s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{5, 1})) << "then the server is not busy";
}

TEST_F(ServiceBalance, SessionsStayWhereAnOperatorMovedThem) {
  start("a", sessions(3));
  start("b");
  order_move("s1", "b");
  pass(1s);
  order_move("s2", "b");
  pass(1s);
  order_move("s3", "b");
  pass(1s);
  ASSERT_EQ(counts(), (std::vector<std::size_t>{0, 3}));
  pass_with_loads(60s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(value("catalogue/s1/home"), "b");
  // Moving a session to its own server keeps it there as well, and its end takes the order with it.
  order_move("s1", "b");
  pass(1s);
  EXPECT_EQ(value("catalogue/s1/move"), "");
  EXPECT_EQ(value("catalogue/s1/home"), "b");
  servers_[1]->member.sessions().end("s1");
  pass(1s);
  EXPECT_FALSE(has("catalogue/s1/home"));
}

TEST_F(ServiceBalance, SessionsThatAnOperatorMovedSpreadAgainWhenTheyMayBeAnywhere) {
  start("a", sessions(3));
  start("b");
  for (const char* session : {"s1", "s2", "s3"}) {
    order_move(session, "b");
    pass(1s);
  }
  pass_with_loads(60s);
  ASSERT_EQ(counts(), (std::vector<std::size_t>{0, 3}));
  for (const char* session : {"s1", "s2", "s3"}) order_move(session, ServiceKeys::kAnyServer);
  pass(1s);
  EXPECT_EQ(value("catalogue/s1/home"), "");
  EXPECT_EQ(value("catalogue/s1/move"), "");
  pass_with_loads(60s);
  EXPECT_GE(counts()[0], 1U);
  EXPECT_GE(counts()[1], 1U);
}

TEST_F(ServiceBalance, NothingMovesWithoutBalanceButADrainMovesAll) {
  start("a", sessions(3), "", false);
  start("b");
  people = {"s2"};
  pass_with_loads(60s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{3, 0}));
  EXPECT_FALSE(servers_[0]->member.sessions().empty());
  draining.insert(servers_[0].get());
  pass_with_loads(10s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{0, 3}));
  EXPECT_TRUE(servers_[0]->member.sessions().empty());
  std::string last;
  for (const ServiceEvent& event : servers_[0]->events)
    if (event.kind == ServiceEvent::Kind::kHandOver) last = event.session + " " + event.text;
  EXPECT_EQ(last, "s2 MOVES to server b, because this server drains") << "people move last";
}

/// The loads that a server plans by are up to a second old.
TEST_F(ServiceBalance, SessionToWhichAPersonHasJustComeStays) {
  Server& a = start("a", sessions(2));
  start("b");
  a.waits = false;
  pass_with_loads(20s);
  const auto asked = std::ranges::count(a.events, ServiceEvent::Kind::kHandOver, &ServiceEvent::kind);
  EXPECT_GE(asked, 1);
  EXPECT_LE(asked, 2) << "each session rests then";
  EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 0}));
  EXPECT_EQ(a.member.status(now_).moves, 0U);
  a.member.sessions().set_snapshot("s1", "newer");
  pass(1s);
  EXPECT_EQ(value("snapshots/s1"), "newer");
  order_move("s1", "b");
  pass(2s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{1, 1})) << "orders still count";
}

TEST_F(ServiceBalance, OrderThatComesDuringAHandOverThatIsNotCarriedOutIsFollowed) {
  Server& a = start("a", sessions(2));
  start("b");
  a.waits = false;
  on_ask = [&, ordered = false](const std::string& session) mutable {
    if (std::exchange(ordered, true)) return;  // a further order would have this one looked at again
    order_move(session, "b");
    for (int n = 0; n < 3; ++n) a.member.step(now_);
  };
  pass_with_loads(10s);
  EXPECT_EQ(value("catalogue/s1/home") + value("catalogue/s2/home"), "b");
}

/// A session that its target does not open must not take all others with it.
TEST_F(ServiceBalance, ServerThatOpensNoSessionGetsOneWhichComesBack) {
  Server& a = start("a", sessions(3));
  Server& b = start("b");
  b.opens = false;
  draining.insert(&a);
  pass_with_loads(60s);
  EXPECT_EQ(std::ranges::count(b.events, ServiceEvent::Kind::kOpen, &ServiceEvent::kind), 1);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{3, 0}));
  EXPECT_FALSE(a.member.empty());
  b.opens = true;
  pass_with_loads(5min);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{0, 3})) << "it gets another one minutes later";
}

TEST_F(ServiceBalance, ServerThatDrainsWaitsUntilItsLastSessionIsKept) {
  Server& a = start("a", sessions(1));
  Server& b = start("b");
  b.opens = false;
  draining.insert(&a);
  for (int n = 0; n < 20; ++n) {
    pass_with_loads(1s);
    ASSERT_FALSE(a.member.empty()) << n;
  }
  EXPECT_EQ(counts(), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(std::ranges::count(b.events, ServiceEvent::Kind::kOpen, &ServiceEvent::kind), 1);
}

TEST_F(ServiceBalance, ServerWithTheMostSessionsGetsNoFurtherOne) {
  Server& a = start("a", sessions(2));
  start("b");
  const auto owner = [](std::size_t n) { return "/tandem/v1/live/sessions/f" + std::to_string(n) + "/owner"; };
  for (std::size_t n = 0; n < rpc::kSessionsMax; ++n)
    static_cast<void>(store_.execute(0, directory::Transaction{{}, {directory::Put{owner(n), "b", 0}}, {}}));
  draining.insert(&a);
  pass_with_loads(10s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 0}));
  static_cast<void>(store_.execute(0, directory::Transaction{{}, {directory::Erase{owner(0)}}, {}}));
  pass_with_loads(10s);
  EXPECT_EQ(counts(), (std::vector<std::size_t>{1, 1}));
}

TEST_F(ServiceBalance, NothingMovesWithoutTheDirectory) {
  Server& a = start("a", sessions(2));
  start("b");
  a.directory.cut = true;
  pass_with_loads(1500ms);  // before its lease is in doubt
  EXPECT_EQ(counts(), (std::vector<std::size_t>{2, 0}));
  EXPECT_EQ(a.member.status(now_).moves, 0U);
}

}  // namespace
}  // namespace tandem::server::test
