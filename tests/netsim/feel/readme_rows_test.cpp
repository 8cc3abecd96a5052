// The rows of README.md that say what hands feel over a delay: the same probes, hands and seeds as `tandem-netsim feel
// contact --delay MS`. Limits are the printed means with a tenth of headroom; the worst seed stays within 1.5 times.
// TANDEM_COUNTS=full takes all 20 seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "netsim/feel/feel_summary.h"
#include "tests/base/counts.h"
#include "tests/netsim/feel/feel_support.h"

namespace tandem::netsim {
namespace {

struct Row {
  int delay_ms;
  double leader_05hz_mm, leader_1hz_mm, leader_step_mm, follower_05hz_mm, gain_max, overshoot;
};
constexpr Row kRows[] = {{0, 0.14, 0.37, 0.22, 1.55, 1.13, 0.135},
                         {20, 0.42, 1.24, 0.87, 1.94, 1.52, 0.255},
                         {50, 0.91, 3.19, 1.93, 3.47, 2.05, 0.383},
                         {100, 2.03, 8.71, 3.41, 9.19, 2.93, 0.528},
                         {200, 6.69, 27.7, 6, 35.2, 4.29, 0.793}};
constexpr double kHeadroom = 1.1, kWorst = 1.5;

void expect_row(const Row& row) {
  SCOPED_TRACE(row.delay_ms);
  FeelSetup setup = contact_over(row.delay_ms, tandem::test::shipped("contact"));
  setup.hands = HandKind::kDrawn;
  std::vector<FeelSeed> seeds;
  const std::uint64_t count = tandem::test::draws(2, 20, 20);
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
  at_most("drag_05hz_n", 0.06);
  at_most("drag_1hz_n", 0.112);
  at_most("leader_tool_05hz_m", 1e-3 * row.leader_05hz_mm);
  at_most("leader_tool_1hz_m", 1e-3 * row.leader_1hz_mm);
  at_most("leader_tool_step_m", 1e-3 * row.leader_step_mm);
  at_most("follower_tool_05hz_m", 1e-3 * row.follower_05hz_mm);
  at_most("gain_max", row.gain_max);
  at_most("overshoot", row.overshoot);
  EXPECT_LE(numbers.at("tool_felt_bone_n").mean, row.delay_ms > 100 ? 0.1 : 0.05);
}

TEST(ReadmeRows, HandsFeelWhatIsPrintedWithoutDelay) { expect_row(kRows[0]); }
TEST(ReadmeRows, HandsFeelWhatIsPrintedAt20Milliseconds) { expect_row(kRows[1]); }
TEST(ReadmeRows, HandsFeelWhatIsPrintedAt50Milliseconds) { expect_row(kRows[2]); }
TEST(ReadmeRows, HandsFeelWhatIsPrintedAt100Milliseconds) { expect_row(kRows[3]); }
TEST(ReadmeRows, HandsFeelWhatIsPrintedAt200Milliseconds) { expect_row(kRows[4]); }

}  // namespace
}  // namespace tandem::netsim
