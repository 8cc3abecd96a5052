// The load that a server publishes for the other servers and for `tandem-server servers`.
#include "server/service/published_load.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"
#include "server/directory/placement/move_planner.h"

namespace tandem::server {
namespace {

TEST(PublishedLoad, StaysWhileTheLoadOfSessionsVariesALittle) {
  RandomStream noise{RandomKey{1}};
  for (double load = 0; load < 2; load += 0.005) {
    double published = published_load(0, load);
    int changes = 0;
    for (int second = 0; second < 200; ++second) {
      const double next = published_load(published, load + 0.014 * (2 * noise.uniform() - 1));
      changes += next != published ? 1 : 0;
      published = next;
    }
    EXPECT_LE(changes, 1) << load;
    EXPECT_NEAR(published, load, 0.055) << load;
  }
}

TEST(PublishedLoad, FollowsALoadThatGrowsOrEnds) {
  double published = 0;
  for (double load = 0; load < 1; load += 0.01) {
    published = published_load(published, load);
    EXPECT_NEAR(published, load, 0.041) << load;
  }
  EXPECT_EQ(published_load(published, 0.004), 0);
  EXPECT_EQ(published_load(0.05, 0.004), 0) << "idle";
}

TEST(PublishedCapacity, CountsNoMoreProcessorsThanThreads) {
  EXPECT_DOUBLE_EQ(published_capacity(0.85, 4, 1), 0.85);
  EXPECT_DOUBLE_EQ(published_capacity(0.85, 4, 8), 3.4);
  EXPECT_DOUBLE_EQ(published_capacity(0.85, 4, 0), 0.85) << "its first session adds a thread";
}

TEST(PublishedCapacity, HasAServerRelievedWhoseOnlyThreadIsFull) {
  const std::vector<directory::Candidate> servers{{"a", "", published_capacity(0.85, 4, 1), 0.8},
                                                  {"b", "", published_capacity(0.85, 4, 4), 0}};
  const std::vector<directory::PlacedSession> sessions{{.session = "lab", .cost = 0.2, .expected = 0.2}};
  directory::MovePlanner planner(RandomKey{1});
  const Time now = Time{} + std::chrono::hours(1);
  EXPECT_FALSE(planner.step(now, servers, "a", sessions));
  const auto move = planner.step(now + directory::MovePlanner::kSettle, servers, "a", sessions);
  ASSERT_TRUE(move);
  EXPECT_EQ(move->why, directory::PlannedMove::Why::kStrain);
}

}  // namespace
}  // namespace tandem::server
