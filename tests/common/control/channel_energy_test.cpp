#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>

#include "common/control/channel.h"
#include "tests/common/base/counts.h"
#include "tests/common/control/energy_oracle.h"

/// The energy at the hand under every law, over the same hostile networks, by one oracle.
namespace tandem::control {
namespace {

using test::judge;
using test::Trial;
using test::Verdict;

/// Result over all channels of a law.
struct Sum {
  double given = -1;   ///< worst [J]
  double axis = -1;    ///< worst of one axis [J]
  double excess = -1;  ///< worst [J]
  double beyond = 0;   ///< channels above the bound of the laws with a ledger at both ends
  double moved = 0;    ///< [m]
  double sent = 0;     ///< share of the samples, mean
  double channels = 0;
  bool finite = true;
};
Sum judge_all(Trial trial, std::uint64_t channels) {
  Sum sum;
  for (trial.seed = 1; trial.seed <= channels; ++trial.seed) {
    const Verdict v = judge(trial);
    sum.given = std::max(sum.given, v.given);
    sum.axis = std::max(sum.axis, v.worst_axis);
    sum.excess = std::max(sum.excess, v.excess);
    sum.moved = std::max(sum.moved, v.moved);
    sum.sent += v.sent / static_cast<double>(channels);
    sum.finite &= v.finite;
    sum.beyond += v.given > 6 * test::kInitialEnergy + 1e-9 || !v.finite ? 1 : 0;
    ++sum.channels;
  }
  return sum;
}
/// Excess above the bound of a law, also that of one axis where the bound holds for each axis [J].
double breach(std::string_view law, const Sum& sum) {
  if (law == "replica") return sum.excess;
  return std::max(sum.excess, sum.axis - test::stated_bound(law) / 3);
}
void print(const std::string& name, const Sum& sum, double bound) {
  std::printf(
      "[  energy  ] %-24s worst %9.3f mJ (one axis %9.3f), bound %6.3f mJ, above 6 E_0 in %3.0f of %.0f channels\n",
      name.c_str(), 1e3 * sum.given, 1e3 * sum.axis, 1e3 * bound, sum.beyond, sum.channels);
}

class EnergyOracle : public testing::TestWithParam<const char*> {};
/// Laws whose ledger limits what they give.
class EnergyOracleOfLedgers : public testing::TestWithParam<const char*> {};

TEST_P(EnergyOracle, GivesAHandNoMoreThanTheStatedBoundOnAnyNetwork) {
  const auto end = make_channel_end(GetParam(), {});
  const double bound = test::stated_bound(GetParam());
  ASSERT_EQ(end->guarantees().ledger, std::isfinite(bound)) << "a law that promises a ledger states a bound";
  const Sum sum = judge_all({.law = GetParam()}, test::seeds(500));
  print(GetParam(), sum, bound);
  if (!end->guarantees().ledger) {
    EXPECT_GT(sum.given, 6 * test::kInitialEnergy) << "this law states no bound because it has none";
    return;
  }
  EXPECT_LE(breach(GetParam(), sum), 1e-9);
  EXPECT_TRUE(sum.finite);
  EXPECT_GT(sum.moved, 0.02) << "a channel that never moves keeps every promise";
  EXPECT_GT(sum.given, 0.1 * bound) << "channels that ask for nothing prove nothing";
}

// Negative control of the oracle for every law with a ledger: with accounts that limit nothing, the oracle of the test
// above finds the breach.
TEST_P(EnergyOracleOfLedgers, FindsTheBreachOfALawWhoseAccountLimitsNothing) {
  const Sum sum = judge_all({.law = GetParam(), .unlimited = true}, 60);
  print(std::string(GetParam()) + ", unlimited", sum, test::stated_bound(GetParam()));
  EXPECT_GT(breach(GetParam(), sum), test::kInitialEnergy);
}

/// Laws under which datagrams may be held back.
class EnergyOracleOfHeldSamples : public testing::TestWithParam<const char*> {};

TEST_P(EnergyOracleOfHeldSamples, KeepsTheStatedBoundAlthoughSamplesAreHeldBack) {
  for (const std::uint32_t order : {0U, 1U}) {
    const Sum sum = judge_all({.law = GetParam(), .dead_band = true, .order = order}, test::seeds(500));
    print(std::string(GetParam()) + ", dead-band " + std::to_string(order), sum, test::stated_bound(GetParam()));
    EXPECT_LE(breach(GetParam(), sum), 1e-9);
    EXPECT_TRUE(sum.finite);
    EXPECT_GT(sum.moved, 0.02);
    EXPECT_GT(sum.given, 0.1 * test::stated_bound(GetParam()));
    std::printf("[  energy  ] %.1f %% of the samples sent\n", 100 * sum.sent);
    EXPECT_LT(sum.sent, 0.8) << "samples are held back";
  }
}

// Negative controls. The oracle finds accounts that limit nothing although samples are held back, and receivers that
// predict energies as they predict motion: these spend what the other end never absorbed.
TEST_P(EnergyOracleOfHeldSamples, FindsTheBreachOfALawWhoseAccountLimitsNothing) {
  const Sum sum = judge_all({.law = GetParam(), .unlimited = true, .dead_band = true}, 60);
  print(std::string(GetParam()) + ", unlimited", sum, test::stated_bound(GetParam()));
  EXPECT_GT(breach(GetParam(), sum), test::kInitialEnergy);
}
TEST(EnergyOracleDeadBand, FindsTheBreachOfReceiversThatPredictEnergies) {
  const Sum sum = judge_all({.law = "set_position", .dead_band = true, .predicts_energy = true}, 100);
  print("set_position, energies predicted", sum, test::stated_bound("set_position"));
  EXPECT_GT(breach("set_position", sum), test::kInitialEnergy);
}

INSTANTIATE_TEST_SUITE_P(Laws, EnergyOracleOfHeldSamples, testing::Values("replica", "set_position"),
                         [](const auto& law) { return std::string(law.param); });

INSTANTIATE_TEST_SUITE_P(Laws, EnergyOracle, testing::Values("replica", "set_position", "tdpa", "wave", "pd", "raw"),
                         [](const auto& law) { return std::string(law.param); });

INSTANTIATE_TEST_SUITE_P(Laws, EnergyOracleOfLedgers, testing::Values("replica", "set_position", "tdpa", "wave"),
                         [](const auto& law) { return std::string(law.param); });

TEST(EnergyOracle, JudgesEveryLaw) {
  for (const ChannelLaw& law : channel_laws()) {
    EXPECT_TRUE(law.name == "replica" || law.name == "set_position" || law.name == "tdpa" || law.name == "wave" ||
                law.name == "pd" || law.name == "raw")
        << law.name << ": add it to the suite above, with its bound";
    EXPECT_EQ(make_channel_end(law.name, {})->guarantees().ledger, law.name != "pd" && law.name != "raw")
        << law.name << ": laws with a ledger are in the suite of ledgers";
  }
}

TEST(EnergyOracle, RawGivesAHandEnergyThatNoEndPaidFor) {  // negative control: the oracle can fail
  EXPECT_FALSE(make_channel_end("raw", {})->guarantees().ledger);
  EXPECT_GE(judge_all({.law = "raw"}, 40).beyond, 36);
}

// The flow sources grant a follower of law `replica` the energy to be led. The force of its motor times the path of the
// tool bounds every grant, so E_0 plus that bounds the energy at the hand.
TEST(EnergyOracle, ReplicaGivesAFollowerAtMostForceTimesThePathOfTheToolBeyondItsBound) {
  const Sum sum = judge_all({.law = "replica", .grants = true}, test::seeds(150));
  print("replica, open sources", sum, std::numeric_limits<double>::quiet_NaN());
  EXPECT_LE(sum.excess, 1e-9);
  EXPECT_TRUE(sum.finite);
  EXPECT_GT(sum.given, test::stated_bound("replica")) << "grants arrive";
}

TEST(PdChannel, IsPassiveAtConstantDelay) {
  const std::uint64_t last = test::seeds(25);
  for (const int delay : {1, 5, 20, 50, 100, 200, 500}) {
    SCOPED_TRACE(delay);
    const Sum pd = judge_all({.law = "pd", .delay = delay}, last),
              raw = judge_all({.law = "raw", .delay = delay}, last);
    print("pd, " + std::to_string(delay) + " ms", pd, 0);
    EXPECT_LE(pd.given, 1e-9);
    EXPECT_LE(pd.axis, 1e-9);
    if (delay >= 20) {
      EXPECT_GE(raw.beyond, last / 10) << "the same hands over the same delay show what the damping is for";
    }
  }
}

}  // namespace
}  // namespace tandem::control
