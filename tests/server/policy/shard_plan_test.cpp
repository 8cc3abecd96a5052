// Number of tick threads per rate, and the first placement of sessions on them.
#include "server/policy/shard_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/base/rng.h"

namespace tandem::server {
namespace {

using Rates = std::vector<double>;
using Placement = std::vector<std::size_t>;

TEST(ShardPlan, GivesEachRateAShardAndTheRestToTheGreatestCostPerShard) {
  const std::vector<SessionDemand> one(9, {1000, 2});
  EXPECT_EQ(shard_rates(one, 1, 0), (Rates{1000}));
  EXPECT_EQ(shard_rates(one, 4, 0), (Rates{1000, 1000, 1000, 1000}));
  // Expected cost: each session counts as 3 clients. 9 of them at 1 kHz and 2 at 4 kHz are as 27 to 24, then 13.5
  // to 24.
  std::vector<SessionDemand> two = one;
  two.insert(two.end(), 2, {4000, 2});
  EXPECT_EQ(shard_rates(two, 1, 0), (Rates{1000, 4000})) << "more rates than threads";
  EXPECT_EQ(shard_rates(two, 3, 0), (Rates{1000, 1000, 4000}));
  EXPECT_EQ(shard_rates(two, 4, 0), (Rates{1000, 1000, 4000, 4000}));
}

TEST(ShardPlan, GivesARateNoMoreShardsThanSessions) {
  EXPECT_EQ(shard_rates(std::vector<SessionDemand>{{1000, 2}}, 8, 0), (Rates{1000}));
  EXPECT_EQ(shard_rates(std::vector<SessionDemand>{{1000, 2}}, 8, 2), (Rates{1000, 1000, 1000}))
      << "two may be created later";
  EXPECT_TRUE(shard_rates({}, 4, 16).empty());
}

TEST(ShardPlan, PlacesEachSessionOnTheShardOfItsRateWithTheLeastExpectedCost) {
  const std::vector<SessionDemand> sessions{{1000, 8}, {1000, 2}, {500, 2}, {1000, 2}, {1000, 2}, {1000, 2}};
  EXPECT_EQ(first_placement(sessions, Rates{1000, 1000, 500}), (Placement{0, 1, 2, 1, 1, 0}))
      << "9 against 3, 6 and 9, then the first of equal ones";
}

TEST(ShardPlan, KeepsShardsWithinTheCostOfOneSession) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r{RandomKey{seed}};
    std::vector<SessionDemand> sessions(1 + r.below(256));
    for (SessionDemand& s : sessions) s = {r.below(3) == 0 ? 500.0 : 1000.0, 1 + r.below(16)};
    const Rates rates = shard_rates(sessions, 1 + r.below(64), 0);
    const Placement placed = first_placement(sessions, rates);
    std::vector<double> cost(rates.size());
    for (std::size_t i = 0; i < sessions.size(); ++i) {
      ASSERT_LT(placed[i], rates.size());
      ASSERT_EQ(rates[placed[i]], sessions[i].tick_hz);
      cost[placed[i]] += expected_cost(sessions[i]);
    }
    for (const double hz : {500.0, 1000.0}) {
      double least = 1e9, most = 0;
      for (std::size_t i = 0; i < rates.size(); ++i)
        if (rates[i] == hz) least = std::min(least, cost[i]), most = std::max(most, cost[i]);
      if (most > 0) {
        EXPECT_LE(most - least, expected_cost({hz, 16}) + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace tandem::server
