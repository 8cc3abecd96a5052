// Rows of netsim/README.md about the distance of a relaxed follower from the leader's hand. They are measured with
// `tandem-netsim feel contact --delay MS --probe follow`, with and without `--assist 1`. Limits are the printed means
// with 10 % headroom; the worst seed stays within 1.5 times. TANDEM_COUNTS=full runs all 20 seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/feel/feel_support.h"

namespace tandem::netsim {
namespace {

struct Printed {
  double still_mm, slow_mm, wander_mm;
};
struct Row {
  int delay_ms;
  Printed none, assist;
};
constexpr Row kRows[] = {{0, {0.049, 0.42, 0.4}, {0.044, 0.155, 0.417}},
                         {20, {0.067, 0.337, 0.689}, {0.065, 0.152, 0.674}},
                         {50, {0.127, 0.335, 1.479}, {0.109, 0.238, 1.111}},
                         {100, {0.276, 0.571, 3.218}, {0.147, 0.505, 1.431}},
                         {200, {0.563, 1.367, 6.19}, {0.169, 1.291, 1.526}}};
constexpr double kHeadroom = 1.1, kWorst = 1.5, kLeast = 0.2;  // [mm]: smaller values depend on a few encoder steps

void expect_printed(int delay_ms, double force, const Printed& printed) {
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
  const auto at_most = [&](const char* key, double mm) {
    EXPECT_LE(1e3 * numbers.at(key).mean, kHeadroom * std::max(kLeast, mm)) << key;
    EXPECT_LE(1e3 * numbers.at(key).worst, kWorst * std::max(kLeast, mm)) << key;
  };
  at_most("follower_offset_still_m", printed.still_mm);
  at_most("follower_offset_slow_m", printed.slow_mm);
  at_most("follower_wander_m", printed.wander_mm);
}

TEST(FollowRows, MatchThePrintedFollowerDistance) {
  for (const Row& row : kRows) expect_printed(row.delay_ms, 0, row.none);
}
TEST(FollowRows, MatchThePrintedFollowerDistanceWithAssist) {
  for (const Row& row : kRows) expect_printed(row.delay_ms, 1, row.assist);
}

}  // namespace
}  // namespace tandem::netsim
