#include "server/directory/placement/move_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/common/base/counts.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;
using Why = PlannedMove::Why;

constexpr Time kLongAgo{}, kNow = Time{} + 1h;

Candidate server(const std::string& name, double used, double expected, bool drains = false) {
  return {name, "", 1, used, drains, expected};
}
PlacedSession waiting(const std::string& name, double expected) {
  return {name, 0.001, expected, true, false, kLongAgo};
}
PlacedSession running(const std::string& name, double cost) { return {name, cost, cost, false, false, kLongAgo}; }

/// A planner that has seen these servers for long enough.
MovePlanner settled(const std::vector<Candidate>& servers) {
  MovePlanner planner(RandomKey{1});
  static_cast<void>(planner.step(kNow - 10s, servers, "none of them", {}));
  return planner;
}

TEST(MovePlanner, SpreadsSessionsThatWaitUntilNoMoveMakesThemMoreEven) {
  // Three sessions of one size on a: one each is left to b and c.
  std::vector<Candidate> servers{server("a", 0, 0.3), server("b", 0, 0), server("c", 0, 0)};
  std::vector<PlacedSession> sessions{waiting("x", 0.1), waiting("y", 0.1), waiting("z", 0.1)};
  MovePlanner planner = settled(servers);
  std::map<std::string, int> count;
  for (int n = 0; n < 10; ++n) {
    const auto move = planner.step(kNow, servers, "a", sessions);
    if (!move) break;
    EXPECT_EQ(move->why, Why::kSpread);
    ++count[move->server];
    std::erase_if(sessions, [&](const PlacedSession& s) { return s.session == move->session; });
    servers[0].expected -= 0.1;  // the records of b and c are old
  }
  EXPECT_EQ(count, (std::map<std::string, int>{{"b", 1}, {"c", 1}}));
}

TEST(MovePlanner, LeavesALoneWhatIsEvenEnough) {
  const std::vector<Candidate> even{server("a", 0, 0.2), server("b", 0, 0.1)};
  EXPECT_FALSE(settled(even).step(kNow, even, "a", std::vector{waiting("x", 0.1), waiting("y", 0.1)}));
  // The only session of a service stays where it is, with people or without.
  const std::vector<Candidate> one{server("a", 0.1, 0.1), server("b", 0, 0)};
  EXPECT_FALSE(settled(one).step(kNow, one, "a", std::vector{waiting("x", 0.1)}));
  EXPECT_FALSE(settled(one).step(kNow, one, "a", std::vector{running("x", 0.1)}));
}

TEST(MovePlanner, MovesPeopleOnlyFromABusyServer) {
  // 0.45 of a capacity of 1 is not busy, although b is idle. 0.9 is.
  const std::vector<Candidate> calm{server("a", 0.45, 0.45), server("b", 0, 0)};
  std::vector<PlacedSession> sessions(9, running("x", 0.05));
  EXPECT_FALSE(settled(calm).step(kNow, calm, "a", sessions));
  const std::vector<Candidate> busy{server("a", 0.9, 0.9), server("b", 0.3, 0.3)};
  sessions = {running("small", 0.1), running("large", 0.25), running("larger than the gap", 0.35)};
  MovePlanner planner = settled(busy);
  // Mean 0.6: the target may have at most that, so that the largest one stays.
  const auto move = planner.step(kNow, busy, "a", sessions);
  ASSERT_TRUE(move);
  EXPECT_EQ(move->session, "large");
  EXPECT_EQ(move->server, "b");
  EXPECT_EQ(move->why, Why::kStrain);
  EXPECT_FALSE(planner.step(kNow + 1s, busy, "a", sessions)) << "one each 3 s";
}

TEST(MovePlanner, NoSessionMovesTwiceWithinItsRest) {
  const std::vector<Candidate> busy{server("a", 0.9, 0.9), server("b", 0.1, 0.1)};
  MovePlanner planner = settled(busy);
  const std::vector<PlacedSession> one{running("x", 0.2)};
  ASSERT_TRUE(planner.step(kNow, busy, "a", one));
  EXPECT_FALSE(planner.step(kNow + 59s, busy, "a", one));
  EXPECT_TRUE(planner.step(kNow + 61s, busy, "a", one));
  PlacedSession fresh = running("y", 0.2);
  fresh.opened = kNow - 59s;
  EXPECT_FALSE(settled(busy).step(kNow, busy, "a", std::vector{fresh}));
  PlacedSession lobby = waiting("z", 0.2);
  lobby.opened = kNow - 4s;
  EXPECT_FALSE(settled(busy).step(kNow, busy, "a", std::vector{lobby}));
}

TEST(MovePlanner, NothingMovesWhileServersComeAndGo) {
  std::vector<Candidate> servers{server("a", 0, 0.3), server("b", 0, 0)};
  const std::vector<PlacedSession> sessions{waiting("x", 0.1), waiting("y", 0.1)};
  MovePlanner planner(RandomKey{1});
  EXPECT_FALSE(planner.step(kNow, servers, "a", sessions));
  EXPECT_FALSE(planner.step(kNow + 2s, servers, "a", sessions));
  servers.push_back(server("c", 0, 0));
  EXPECT_FALSE(planner.step(kNow + 4s, servers, "a", sessions));
  EXPECT_FALSE(planner.step(kNow + 6s, servers, "a", sessions));
  EXPECT_TRUE(planner.step(kNow + 7s, servers, "a", sessions));
}

TEST(MovePlanner, AServerThatDrainsEmptiesItselfPeopleLast) {
  std::vector<Candidate> servers{server("a", 0.2, 0.2, true), server("b", 0.5, 0.5), server("c", 0, 0, true)};
  std::vector<PlacedSession> sessions{running("people", 0.2), waiting("lobby", 0.1)};
  sessions[0].pinned = sessions[1].pinned = true;
  sessions[0].opened = sessions[1].opened = kNow;
  MovePlanner planner(RandomKey{1});
  for (const char* expected : {"lobby", "people"}) {
    const auto move = planner.step(kNow, servers, "a", sessions);
    ASSERT_TRUE(move);
    EXPECT_EQ(move->session, expected);
    EXPECT_EQ(move->server, "b");
    EXPECT_EQ(move->why, Why::kDrain);
    std::erase_if(sessions, [&](const PlacedSession& s) { return s.session == move->session; });
  }
  EXPECT_FALSE(planner.step(kNow, servers, "a", sessions));
  servers[1].used = 0.95;
  EXPECT_FALSE(planner.step(kNow + 10s, servers, "a", std::vector{running("too much", 0.2)}));
}

TEST(MovePlanner, OrdersOfOperatorsHold) {
  const std::vector<Candidate> servers{server("a", 0.9, 0.9), server("b", 0, 0)};
  std::vector<PlacedSession> sessions{running("x", 0.2), waiting("y", 0.2)};
  for (PlacedSession& session : sessions) session.pinned = true;
  EXPECT_FALSE(settled(servers).step(kNow, servers, "a", sessions));
  sessions[1].pinned = false;
  EXPECT_EQ(settled(servers).step(kNow, servers, "a", sessions)->session, "y");
}

TEST(MovePlanner, UsesNoServerWithoutCapacityNorAClosedOneAndNoRecordThatIsMissing) {
  std::vector<Candidate> servers{server("a", 0.9, 0.9), server("b", 0, 0)};
  servers[1].capacity = 0;
  const std::vector<PlacedSession> sessions{running("x", 0.2), waiting("y", 0.2)};
  EXPECT_FALSE(settled(servers).step(kNow, servers, "a", sessions));
  servers[1].capacity = 1;
  servers[1].closed = true;
  EXPECT_FALSE(settled(servers).step(kNow, servers, "a", sessions));
  servers[1].closed = false;
  servers[0].capacity = 0;
  EXPECT_FALSE(settled(servers).step(kNow, servers, "a", sessions));
  EXPECT_FALSE(settled(servers).step(kNow, servers, "unknown", sessions));
  EXPECT_FALSE(MovePlanner(RandomKey{1}).step(kNow, {}, "a", sessions));
}

/// Any servers with any waiting sessions, all planning by records that are a second old, become even and stay so.
TEST(MovePlanner, AnyServiceBecomesEvenAndThenRests) {
  const std::uint64_t seeds = tandem::test::seeds(50);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    RandomStream d(seed);
    struct Server {
      MovePlanner planner;
      std::vector<PlacedSession> sessions{};
    };
    std::vector<Server> all;
    const std::size_t count = 2 + d.below(5);
    for (std::size_t n = 0; n < count; ++n) all.push_back({MovePlanner(RandomKey{seed * 100 + n})});
    for (int s = 0; s < 30; ++s) all[d.below(2)].sessions.push_back(waiting(std::to_string(s), d.uniform(0.01, 0.05)));
    const auto expected = [](const Server& of) {
      double sum = 0;
      for (const PlacedSession& session : of.sessions) sum += session.expected;
      return sum;
    };
    std::vector<double> published(count, 0);
    Time now = kNow, last_move = kNow;
    for (; now < kNow + 20min; now += 250ms) {
      if ((now - kNow) % 1s == 0s) std::ranges::transform(all, published.begin(), expected);
      for (std::size_t n = 0; n < count; ++n) {
        std::vector<Candidate> servers;
        for (std::size_t k = 0; k < count; ++k)
          servers.push_back(server(std::to_string(k), 0, k == n ? expected(all[k]) : published[k]));
        const auto move = all[n].planner.step(now, servers, std::to_string(n), all[n].sessions);
        if (!move) continue;
        const auto moving = std::ranges::find(all[n].sessions, move->session, &PlacedSession::session);
        Server& to = all[static_cast<std::size_t>(std::stoi(move->server))];
        to.sessions.push_back(*moving);
        to.sessions.back().opened = now;
        all[n].sessions.erase(moving);
        last_move = now;
      }
    }
    EXPECT_LT(last_move, kNow + 5min) << "seed " << seed << " does not rest";
    double most = 0, sum = 0;
    for (const Server& of : all) most = std::max(most, expected(of)), sum += expected(of);
    EXPECT_LE(most - sum / static_cast<double>(count), 0.05) << "seed " << seed << ": more than one session above";
  }
}

}  // namespace
}  // namespace tandem::directory
