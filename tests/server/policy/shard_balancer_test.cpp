// Which session moves from a strained tick thread to another: by hand, and as properties over seeds.
#include "server/policy/shard_balancer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/rng.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// Shards and sessions whose loads are the sums of their costs, and the balancer that is asked four times a second.
struct Pool {
  explicit Pool(std::vector<double> tick_hz) : rates(std::move(tick_hz)) {}
  void add(std::size_t shard, double cost) { sessions.push_back({sessions.size(), shard, cost}); }
  /// Costs and loads as measured: each cost is off by at most `noise`.
  std::optional<SessionMove> step(RandomStream* noise = nullptr, double most = 0) {
    now += 250ms;
    std::vector<ShardView> shards;
    for (const double hz : rates) shards.push_back({hz, 0});
    std::vector<SessionView> seen = sessions;
    for (SessionView& s : seen) {
      if (noise != nullptr) s.cost *= 1 + most * (2 * noise->uniform() - 1);
      shards[s.shard].load += s.cost;
    }
    const auto move = balancer.step(now, shards, seen);
    if (move) {
      EXPECT_EQ(sessions[move->slot].shard, move->from);
      EXPECT_EQ(rates[move->from], rates[move->to]);
      EXPECT_NE(move->from, move->to);
      sessions[move->slot].shard = move->to;
    }
    return move;
  }
  [[nodiscard]] double load(std::size_t shard) const {
    double sum = 0;
    for (const SessionView& s : sessions) sum += s.shard == shard ? s.cost : 0;
    return sum;
  }
  std::vector<double> rates;
  std::vector<SessionView> sessions;
  ShardBalancer balancer;
  Time now{};
};

/// First move within a time.
std::optional<SessionMove> first_move(Pool& pool, Duration within) {
  for (const Time end = pool.now + within; pool.now < end;)
    if (const auto move = pool.step()) return move;
  return std::nullopt;
}

TEST(ShardBalancer, MovesTheSessionThatBringsTheLoadsClosestTogether) {
  Pool pool{{1000, 1000}};
  for (const double cost : {0.05, 0.19, 0.15, 0.1}) pool.add(0, cost);  // 0.49 in all
  pool.add(1, 0.1);
  // 0.19 leaves 0.30 and 0.29; 0.05 and 0.1 leave more at shard 0.
  EXPECT_EQ(first_move(pool, 1s), std::nullopt) << "strained for less than two seconds";
  EXPECT_EQ(first_move(pool, 5s), (SessionMove{1, 0, 1}));
  EXPECT_EQ(first_move(pool, 60s), std::nullopt) << "no shard is strained";
}

TEST(ShardBalancer, MovesNothingThatWouldMakeTheTargetTheBusierOne) {
  Pool alone{{1000, 1000}};
  alone.add(0, 0.7);
  EXPECT_EQ(first_move(alone, 60s), std::nullopt);
  Pool full{{1000, 1000}};
  for (int i = 0; i < 8; ++i) full.add(static_cast<std::size_t>(i % 2), 0.15);
  EXPECT_EQ(first_move(full, 60s), std::nullopt) << "both are strained alike";
  Pool rates{{1000, 500}};
  for (int i = 0; i < 4; ++i) rates.add(0, 0.15);
  EXPECT_EQ(first_move(rates, 60s), std::nullopt) << "the other shard has another rate";
  Pool one{{1000}};
  for (int i = 0; i < 4; ++i) one.add(0, 0.15);
  EXPECT_EQ(first_move(one, 60s), std::nullopt);
}

TEST(ShardBalancer, WaitsBetweenTwoMovesAndRestsEachSession) {
  Pool pool{{1000, 1000, 1000}};
  for (int i = 0; i < 8; ++i) pool.add(0, 0.1);
  std::vector<Time> at;
  while (pool.now < Time{} + 60s)
    if (pool.step()) at.push_back(pool.now);
  ASSERT_GE(at.size(), 4U) << "from 0.8 to below 0.4";
  for (std::size_t i = 1; i < at.size(); ++i) EXPECT_GE(at[i] - at[i - 1], ShardBalancer::kBetweenMoves);
  Pool again{{1000, 1000}};
  for (const double cost : {0.3, 0.25}) again.add(0, cost);
  ASSERT_EQ(first_move(again, 10s), (SessionMove{1, 0, 1}));
  const Time moved = again.now;
  again.sessions[0].cost = 0;  // it ended, and a session of 0.4 was placed beside the one that moved
  again.sessions[1].cost = 0.3;
  again.add(1, 0.4);
  ASSERT_EQ(first_move(again, 2min), (SessionMove{1, 1, 0}));
  EXPECT_GE(again.now - moved, ShardBalancer::kRest);
}

TEST(ShardBalancer, IgnoresAShortStrain) {
  Pool pool{{1000, 1000}};
  for (int i = 0; i < 5; ++i) pool.add(0, 0.05);
  for (int i = 0; i < 200; ++i) {
    const double cost = i % 8 < 4 ? 0.1 : 0.05;  // a second at 0.50, a second at 0.25
    for (SessionView& s : pool.sessions) s.cost = cost;
    EXPECT_EQ(pool.step(), std::nullopt) << i;
  }
}

TEST(ShardBalancer, LowersTheGreaterLoadWithEveryMoveAndEnds) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r{RandomKey{seed}};
    Pool pool{std::vector<double>(2 + r.below(7), 1000)};
    const std::uint64_t sessions = 1 + r.below(150);
    for (std::uint64_t i = 0; i < sessions; ++i)
      pool.add(r.below(pool.rates.size()), (0.2 + r.uniform()) * 3.0 / static_cast<double>(sessions));
    Time last{};
    while (pool.now < Time{} + 20min) {
      std::vector<double> before;
      for (std::size_t i = 0; i < pool.rates.size(); ++i) before.push_back(pool.load(i));
      const auto move = pool.step();
      if (!move) continue;
      last = pool.now;
      EXPECT_GE(before[move->from], ShardBalancer::kStrained);
      EXPECT_LT(std::max(pool.load(move->from), pool.load(move->to)), before[move->from]);
    }
    EXPECT_LT(last, Time{} + 15min) << "the loads do not change, so the moves end";
  }
}

TEST(ShardBalancer, DoesNotMoveSessionsToAndFroWhenMeasurementsVary) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r{RandomKey{seed}};
    Pool pool{{1000, 1000, 1000}};
    for (int i = 0; i < 30; ++i) pool.add(0, 0.045);  // 1.35 on one of three: 0.45 each at the end, all strained
    int moves = 0, late = 0;
    while (pool.now < Time{} + 30min) {
      if (!pool.step(&r, 0.1)) continue;
      ++moves;
      if (pool.now > Time{} + 5min) ++late;
    }
    EXPECT_GE(moves, 17) << "20 of 30 must leave, to a difference of 0.10";
    EXPECT_LE(moves, 25);
    EXPECT_EQ(late, 0);
  }
}

TEST(ShardBalancer, FindsTheLeastLoadedShardOfARate) {
  const std::vector<ShardView> shards{{1000, 0.3}, {500, 0.1}, {1000, 0.2}, {1000, 0.2}};
  EXPECT_EQ(least_loaded(shards, 1000), 2U);
  EXPECT_EQ(least_loaded(shards, 500), 1U);
  EXPECT_EQ(least_loaded(shards, 4000), std::nullopt);
  EXPECT_EQ(least_loaded({}, 1000), std::nullopt);
}

}  // namespace
}  // namespace tandem::server
