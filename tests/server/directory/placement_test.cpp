#include "server/directory/placement/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "server/directory/placement/server_record.h"
#include "tests/common/base/counts.h"

namespace tandem::directory {
namespace {

TEST(ServerRecord, ReadsWhatItWrites) {
  const ServerRecord record{"10.0.0.1:7000", "ab12", "1.2", "rack 4", 3.5, 1.25, true, 2.5, "0aff"};
  EXPECT_EQ(parse_server_record(to_text(record)), record);
  EXPECT_EQ(parse_server_record(to_text(record) + "colour blue\n"), record);
  // An older version publishes no expected load.
  const std::string text = to_text(record), line = "expected 2.5000\n";
  std::string older = text;
  ASSERT_NE(older.find(line), std::string::npos);
  older.erase(older.find(line), line.size());
  EXPECT_EQ(parse_server_record(older)->expected, 1.25);
}

TEST(ServerRecord, RefusesTextThatCannotBeUsed) {
  const std::string good = to_text({"a:1", "k", "v", "", 1, 0});
  ASSERT_TRUE(parse_server_record(good));
  for (std::size_t cut = 0; cut < good.find("used 0"); ++cut) EXPECT_FALSE(parse_server_record(good.substr(0, cut)));
  EXPECT_FALSE(parse_server_record(good + good));
  EXPECT_FALSE(parse_server_record(std::string(kServerRecordMax + 1, 'x')));
  for (const char* number : {"nan", "inf", "-1", "1x", "", "1e999"}) {
    std::string bad = good;
    bad.replace(bad.find("capacity ") + 9, 6, number);
    EXPECT_FALSE(parse_server_record(bad)) << number;
  }
}

TEST(Placement, TakesTheLessUsedShareOfTwo) {
  // With two candidates, each draw is a, a or b, b or both: the emptier one gets three quarters.
  const std::vector<Candidate> both{{"a", "", 1, 0.5}, {"b", "", 4, 1.0}};
  Placement placement(RandomKey{1});
  int b = 0;
  for (int n = 0; n < 4000; ++n) b += placement.place(both, 0.1) == "b" ? 1 : 0;
  EXPECT_NEAR(b, 3000, 150);
}

TEST(Placement, PlacesNothingWhereThereIsNoRoom) {
  Placement placement(RandomKey{1});
  EXPECT_FALSE(placement.place({}, 0.1));
  EXPECT_FALSE(
      placement.place(std::vector<Candidate>{{"a", "", 1, 0.95}, {"b", "", 1, 0, true}, {"c", "", 0, 0}}, 0.1));
  EXPECT_EQ(placement.place(std::vector<Candidate>{{"a", "", 1, 0.95}, {"b", "", 1, 0.9}}, 0.1), "b");
}

TEST(Placement, AStandbyIsInAnotherZoneIfOneHasRoom) {
  Placement placement(RandomKey{1});
  const std::vector<Candidate> candidates{{"a", "x", 1, 0}, {"b", "x", 1, 0}, {"c", "y", 1, 0.5}};
  for (int n = 0; n < 50; ++n) {
    EXPECT_EQ(placement.place_standby(candidates, 0.1, "a"), "c");
    EXPECT_NE(placement.place_standby(candidates, 0.1, "c"), "c");
    EXPECT_EQ(placement.place_standby(candidates, 0.6, "a"), "b");
  }
  EXPECT_FALSE(placement.place_standby(std::vector<Candidate>{{"a", "x", 1, 0}}, 0.1, "a"));
}

TEST(Placement, AStandbyStaysUnlessItDrainsOrAnotherZoneHasRoom) {
  Placement placement(RandomKey{1});
  std::vector<Candidate> candidates{{"a", "x", 1, 0}, {"b", "x", 1, 0}, {"c", "y", 1, 0.95}, {"d", "z", 1, 0}};
  EXPECT_FALSE(placement.place_standby(candidates, 0.1, "a", "c")) << "its load of the moment does not count";
  EXPECT_EQ(placement.place_standby(candidates, 0.1, "a", "b"), "d");
  EXPECT_FALSE(placement.place_standby(candidates, 0.1, "a", "of a later release"));
  candidates[3].closed = true;
  EXPECT_FALSE(placement.place_standby(candidates, 0.1, "a", "b"));
  candidates[1].drains = true;
  EXPECT_FALSE(placement.place_standby(candidates, 0.1, "a", "b")) << "none has room";
  candidates[1].drains = false;
  candidates[3].drains = true;
  EXPECT_EQ(placement.place_standby(candidates, 0.1, "a", "d"), "b");
  for (Candidate& candidate : candidates) candidate.zone.clear();
  EXPECT_FALSE(placement.place_standby(candidates, 0.1, "a", "b"));
}

TEST(Placement, MeanUseCountsNoCapacityOfAServerThatDrains) {
  EXPECT_DOUBLE_EQ(mean_use(std::vector<Candidate>{{"a", "", 1, 0.2, true}, {"b", "", 1, 0.8}}), 1.0);
  EXPECT_EQ(mean_use({}), 0);
}

TEST(Placement, KeepsAnyServersWithinTheirCapacity) {
  const std::uint64_t seeds = tandem::test::seeds(50);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    RandomStream d(seed);
    std::vector<Candidate> servers;
    for (std::uint64_t n = 1 + d.below(20); n > 0; --n)
      servers.push_back({std::to_string(n), std::to_string(d.below(3)), d.uniform(0, 4), 0, d.below(5) == 0});
    Placement placement(RandomKey{seed});
    for (int n = 0; n < 500; ++n) {
      const double cost = d.uniform(0, 0.2);
      const auto chosen = placement.place(servers, cost);
      const auto fits = [&](const Candidate& c) { return !c.drains && c.capacity > 0 && c.used + cost <= c.capacity; };
      ASSERT_EQ(chosen.has_value(), std::ranges::any_of(servers, fits)) << "seed " << seed;
      if (!chosen) continue;
      Candidate& to = *std::ranges::find(servers, *chosen, &Candidate::server);
      ASSERT_TRUE(fits(to)) << "seed " << seed;
      to.used += cost;
    }
  }
}

}  // namespace
}  // namespace tandem::directory
