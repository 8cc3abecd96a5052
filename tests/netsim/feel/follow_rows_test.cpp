// Rows of netsim/README.md about the distance of a relaxed follower from the leader's hand. They are measured with
// `tandem-netsim feel contact --delay MS --probe follow`, with and without `--assist 1`. Limits are the printed means
// and worst hands of 20 with 10 % headroom. TANDEM_COUNTS=full runs all 20 seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/feel/feel_support.h"

namespace tandem::netsim {
namespace {

struct Printed {  // [mm]
  double mean, worst;
};
struct Distances {
  Printed still, slow, wander;
};
struct Row {
  int delay_ms;
  Distances none, assist;
};
constexpr Row kRows[] = {{0, {{0.05, 0.07}, {0.42, 0.45}, {0.40, 0.47}}, {{0.04, 0.07}, {0.16, 0.17}, {0.42, 0.49}}},
                         {20, {{0.07, 0.10}, {0.34, 0.39}, {0.69, 0.79}}, {{0.07, 0.10}, {0.15, 0.17}, {0.67, 0.78}}},
                         {50, {{0.13, 0.18}, {0.34, 0.39}, {1.5, 1.7}}, {{0.11, 0.16}, {0.24, 0.29}, {1.1, 1.4}}},
                         {100, {{0.28, 0.43}, {0.57, 0.65}, {3.2, 3.9}}, {{0.15, 0.24}, {0.51, 0.57}, {1.4, 1.9}}},
                         {200, {{0.56, 0.87}, {1.4, 1.7}, {6.2, 7.2}}, {{0.17, 0.29}, {1.3, 1.5}, {1.5, 2.1}}}};
constexpr double kHeadroom = 1.1, kLeast = 0.2;  // [mm]: smaller values depend on a few encoder steps

void expect_printed(int delay_ms, double force, const Distances& printed) {
  SCOPED_TRACE(std::to_string(delay_ms) + " ms, assist of " + std::to_string(force) + " N");
  FeelSetup setup = contact_over(delay_ms, tandem::test::shipped("contact"));
  setup.hands = HandKind::kDrawn;
  for (SeatSpec& seat : setup.scene.seats) seat.assist.force = force;
  std::vector<FeelSeed> seeds;
  const std::uint64_t count = tandem::test::draws(3, 20, 20);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const ProbeResult result = probe_follow(setup, seed);
    EXPECT_EQ(result.trouble, "");
    seeds.push_back({seed, result.values});
  }
  const auto numbers = summarised(seeds);
  const auto at_most = [&](const char* key, const Printed& limit) {
    EXPECT_LE(1e3 * numbers.at(key).mean, kHeadroom * std::max(kLeast, limit.mean)) << key;
    EXPECT_LE(1e3 * numbers.at(key).worst, kHeadroom * std::max(kLeast, limit.worst)) << key;
  };
  at_most("follower_offset_still_m", printed.still);
  at_most("follower_offset_slow_m", printed.slow);
  at_most("follower_wander_m", printed.wander);
}

TEST(FollowRows, MatchThePrintedFollowerDistance) {
  for (const Row& row : kRows) expect_printed(row.delay_ms, 0, row.none);
}
TEST(FollowRows, MatchThePrintedFollowerDistanceWithAssist) {
  for (const Row& row : kRows) expect_printed(row.delay_ms, 1, row.assist);
}

}  // namespace
}  // namespace tandem::netsim
