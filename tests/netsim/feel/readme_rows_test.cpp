// Rows of netsim/README.md about the forces that hands feel over a delay, with the probes, hands and seeds of
// `tandem-netsim feel contact --delay MS`. Limits are the printed means with 10 % headroom; the worst seed stays
// within 1.5 times. TANDEM_COUNTS=full runs all 20 seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/feel/feel_support.h"

namespace tandem::netsim {
namespace {

struct Row {
  int delay_ms;
  double leader_05hz_mm, leader_1hz_mm, leader_step_mm, follower_05hz_mm, gain_max, overshoot;
};
constexpr Row kRows[] = {{0, 0.03, 0.05, 0.03, 1.45, 1.04, 0.07},
                         {20, 0.26, 0.39, 0.55, 1.67, 1.23, 0.104},
                         {50, 0.88, 1.77, 1.6, 3.43, 1.70, 0.19},
                         {100, 1.82, 6.8, 3, 9.85, 2.44, 0.322},
                         {200, 6.2, 23.7, 5.2, 38.2, 3.6, 0.465}};
constexpr double kHeadroom = 1.1, kWorst = 1.5;
constexpr std::uint64_t kAllHands = 20;

void expect_row(const Row& row) {
  SCOPED_TRACE(row.delay_ms);
  FeelSetup setup = contact_over(row.delay_ms, tandem::test::shipped("contact"));
  setup.hands = HandKind::kDrawn;
  std::vector<FeelSeed> seeds;
  const std::uint64_t count = tandem::test::draws(2, kAllHands, kAllHands);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    FeelSeed one{seed, {}};
    for (const Probe probe : {Probe::kPress, Probe::kFree, Probe::kGain}) {
      const ProbeResult result = run_probe(probe, setup, seed);
      EXPECT_EQ(result.trouble, "");
      one.values.insert(result.values.begin(), result.values.end());
    }
    seeds.push_back(std::move(one));
  }
  const auto numbers = summarised(seeds);
  const auto at_most = [&](const char* key, double printed) {
    EXPECT_LE(numbers.at(key).mean, kHeadroom * printed) << key;
    EXPECT_LE(numbers.at(key).worst, kWorst * printed) << key;
  };
  EXPECT_GE(numbers.at("stiffness_felt_n_m").worst, 360);
  EXPECT_GE(numbers.at("stiffness_tissue_n_m").worst, 164);
  at_most("drag_05hz_n", 0.052);
  at_most("drag_1hz_n", 0.092);
  at_most("leader_tool_05hz_m", 1e-3 * row.leader_05hz_mm);
  at_most("leader_tool_1hz_m", 1e-3 * row.leader_1hz_mm);
  at_most("leader_tool_step_m", 1e-3 * row.leader_step_mm);
  at_most("follower_tool_05hz_m", 1e-3 * row.follower_05hz_mm);
  at_most("gain_max", row.gain_max);
  // The hands themselves overshoot the goal by 3 to 9 %. The first two, which a short run uses, overshoot by 2 % more
  // than the mean.
  at_most("overshoot", row.overshoot + (count < kAllHands ? 0.02 : 0));
  EXPECT_LE(numbers.at("overshoot_above_hand").mean, kHeadroom * row.overshoot);
  EXPECT_LE(numbers.at("tool_felt_bone_n").mean, 0.05);
}

TEST(ReadmeRows, MatchThePrintedValuesWithoutDelay) { expect_row(kRows[0]); }
TEST(ReadmeRows, MatchThePrintedValuesAt20Milliseconds) { expect_row(kRows[1]); }
TEST(ReadmeRows, MatchThePrintedValuesAt50Milliseconds) { expect_row(kRows[2]); }
TEST(ReadmeRows, MatchThePrintedValuesAt100Milliseconds) { expect_row(kRows[3]); }
TEST(ReadmeRows, MatchThePrintedValuesAt200Milliseconds) { expect_row(kRows[4]); }

}  // namespace
}  // namespace tandem::netsim
