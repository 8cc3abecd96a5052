// Loss models other than Bernoulli and the periods in time.
#include "netsim/models/loss_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "netsim/profiles/profile_loader.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Law = LossBurstsSpec::Law;
using Unit = LossBurstsSpec::Unit;

/// Returns 1 for each lost datagram, of `count` datagrams sent every `period`.
std::vector<bool> losses(const LossSpec& loss, std::size_t count, Duration period = 1ms, std::uint64_t seed = 7) {
  PathSpec spec;
  spec.loss = loss;
  std::vector<bool> lost;
  for (const PathDecision& v : decisions(path_of(spec, seed), count, period))
    lost.push_back(v.outcome == Outcome::kLost);
  return lost;
}

std::string bits(const std::vector<bool>& lost) {
  std::string text;
  for (const bool bit : lost) text += bit ? '1' : '0';
  return text;
}

double share(const std::vector<bool>& lost) {
  return static_cast<double>(std::count(lost.begin(), lost.end(), true)) / static_cast<double>(lost.size());
}

/// Returns the number of loss runs of length 1, 2, ...; the last entry counts all longer runs.
std::vector<double> runs_of(const std::vector<bool>& lost, std::size_t kinds) {
  std::vector<double> runs(kinds);
  std::size_t run = 0;
  for (const bool bit : lost) {
    if (!bit && run > 0) ++runs[std::min(run, kinds) - 1];
    run = bit ? run + 1 : 0;
  }
  return runs;
}

/// Chi-square of `seen` against shares that sum to 1.
double chi_square(const std::vector<double>& seen, const std::vector<double>& shares) {
  const double n = std::accumulate(seen.begin(), seen.end(), 0.0);
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) sum += std::pow(seen[i] - n * shares[i], 2) / (n * shares[i]);
  return sum;
}

/// Shares of a geometric distribution with mean 1/r, with bins as in runs_of.
std::vector<double> geometric(double r, std::size_t kinds) {
  std::vector<double> shares;
  double rest = 1;
  for (std::size_t k = 1; k < kinds; ++k, rest *= 1 - r) shares.push_back(rest * r);
  shares.push_back(rest);
  return shares;
}

constexpr double kChiSquare7 = 40.5;  // 7 degrees of freedom, 1e-6

TEST(GilbertElliott, AlternatesAtProbabilityOne) {
  const std::string text = bits(losses({.gilbert_elliott = GilbertElliottSpec{.p = 1, .r = 1}}, 6));
  EXPECT_TRUE(text == "010101" || text == "101010") << text;
  EXPECT_EQ(share(losses({.gilbert_elliott = GilbertElliottSpec{.p = 0.1, .r = 0.1, .h = 1, .k = 1}}, 10'000)), 0);
  EXPECT_EQ(share(losses({.gilbert_elliott = GilbertElliottSpec{.p = 0.1, .r = 0.1, .h = 0, .k = 0}}, 10'000)), 1);
}

TEST(GilbertElliott, LosesItsClosedFormInGeometricRuns) {
  const double p = 0.02, r = 0.25;
  for (std::uint64_t seed = 1; seed <= tandem::test::seeds(2); ++seed) {
    SCOPED_TRACE(seed);
    constexpr std::size_t n = 1'000'000;
    const auto lost = losses({.gilbert_elliott = GilbertElliottSpec{.p = p, .r = r}}, n, 1ms, seed);
    const double expected = p / (p + r), rho = 1 - p - r;
    const double n_eff = static_cast<double>(n) * (1 - rho) / (1 + rho);
    EXPECT_NEAR(share(lost), expected, 4.9 * std::sqrt(expected * (1 - expected) / n_eff));
    EXPECT_LT(chi_square(runs_of(lost, 8), geometric(r, 8)), kChiSquare7);
  }
  const auto mixed = losses({.gilbert_elliott = GilbertElliottSpec{.p = p, .r = r, .h = 0.4, .k = 0.99}}, 1'000'000);
  EXPECT_NEAR(share(mixed), (0.01 * r + 0.6 * p) / (p + r), 0.002);
}

TEST(GilbertElliott, HasItsTransitionProbabilities) {
  GilbertElliott chain{{.p = 0.03, .r = 0.2}, RandomKey{5}};
  std::array<std::size_t, 2> from{}, changed{};
  bool before = chain.bad();
  for (std::uint64_t i = 0; i < 1'000'000; ++i) {
    static_cast<void>(chain.lost(i));
    ++from[before ? 1 : 0];
    changed[before ? 1 : 0] += chain.bad() != before ? 1 : 0;
    before = chain.bad();
  }
  EXPECT_TRUE(binomial_fits(changed[0], from[0], 0.03));
  EXPECT_TRUE(binomial_fits(changed[1], from[1], 0.2));
}

TEST(FourState, FollowsTransitionsOfProbabilityOne) {
  // 1 -> 3 -> 2 -> 3 -> 2 would never end. With p31 the sequence is 1 -> 3 -> 1 -> 3.
  EXPECT_EQ(bits(losses({.four_state = FourStateSpec{.p13 = 1, .p31 = 1}}, 6)), "101010");
  EXPECT_EQ(bits(losses({.four_state = FourStateSpec{.p14 = 1}}, 6)), "101010");
  EXPECT_EQ(bits(losses({.four_state = FourStateSpec{}}, 6)), "000000");
}

TEST(FourState, SpendsItsStationarySharesInEachState) {
  const FourStateSpec s{.p13 = 0.05, .p31 = 0.2, .p32 = 0.3, .p23 = 0.4, .p14 = 0.02};
  // Balance equations: x3 p31 = x1 p13; x2 p23 = x3 p32; x4 = x1 p14.
  std::array<double, 4> x{1, s.p13 / s.p31 * s.p32 / s.p23, s.p13 / s.p31, s.p14};
  const double sum = x[0] + x[1] + x[2] + x[3];
  FourState chain{s, RandomKey{3}};
  std::array<double, 4> seen{};
  constexpr std::size_t n = 1'000'000;
  for (std::uint64_t i = 0; i < n; ++i) {
    static_cast<void>(chain.lost(i));
    ++seen[static_cast<std::size_t>(chain.state() - 1)];
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(seen[i] / n, x[i] / sum, 0.005) << i + 1;
}

LossSpec bursts(double rate, Law law, Unit unit, double length, double cap, double alpha = 1) {
  return {.bursts = LossBurstsSpec{rate, law, unit, length, alpha, cap}};
}

TEST(LossBursts, HaveTheirLengthInDatagrams) {
  const auto lost = losses(bursts(0.5, Law::kFixed, Unit::kDatagrams, 5, 5), 2'000'000);
  const auto runs = runs_of(lost, 8);
  const double n = std::accumulate(runs.begin(), runs.end(), 0.0);
  EXPECT_NEAR(n, 1000, 5 * std::sqrt(1000.0));  // 0.5 per s in 2000 s
  EXPECT_GT(runs[4], 0.98 * n);                 // the others overlapped
  EXPECT_EQ(runs[0] + runs[1] + runs[2] + runs[3], 0);
}

TEST(LossBursts, GeometricAndParetoLengthsFollowTheirLaws) {
  // Rare bursts hardly overlap (rate 1/s, a few ms each), so that observed runs are the drawn lengths.
  const auto geo = losses(bursts(1, Law::kGeometric, Unit::kDatagrams, 2, 1000), 4'000'000);
  EXPECT_LT(chi_square(runs_of(geo, 8), geometric(0.5, 8)), kChiSquare7 + 20);
  const auto pareto = losses(bursts(1, Law::kParetoII, Unit::kDatagrams, 3, 1000, 1.5), 4'000'000);
  std::vector<double> shares;
  for (int k = 0; k < 7; ++k) shares.push_back(std::pow(1 + k / 3.0, -1.5) - std::pow(1 + (k + 1) / 3.0, -1.5));
  shares.push_back(std::pow(1 + 7 / 3.0, -1.5));
  EXPECT_LT(chi_square(runs_of(pareto, 8), shares), kChiSquare7 + 20);
}

TEST(LossBursts, NoneIsLongerThanTheCap) {
  const auto lost = losses(bursts(0.2, Law::kParetoII, Unit::kDatagrams, 20, 20, 0.5), 2'000'000);
  const auto runs = runs_of(lost, 100);
  EXPECT_GT(runs[19], 100);
  EXPECT_EQ(std::accumulate(runs.begin() + 41, runs.end(), 0.0), 0);  // at most two adjacent bursts
}

TEST(LossBursts, AreIndependentOfTheRateInMilliseconds) {
  const LossSpec spec = bursts(2, Law::kGeometric, Unit::kMilliseconds, 20, 1000);
  const auto fast = losses(spec, 2'000'000, 1ms);
  const auto slow = losses(spec, 100'000, 20ms);
  for (std::size_t i = 0; i < slow.size(); ++i) ASSERT_EQ(slow[i], fast[20 * i]) << i;
  EXPECT_NEAR(share(fast), 1 - std::exp(-2 * 0.020), 0.003);
}

TEST(LossPattern, LosesExactlyItsPattern) {
  EXPECT_EQ(bits(losses({.pattern = LossPatternSpec{.every = 3}}, 9)), "001001001");
  EXPECT_EQ(bits(losses({.pattern = LossPatternSpec{.indices = {0, 3, 4}}}, 6)), "100110");
  // The first datagram at or after 2.5 ms is that of 3 ms; two times before one datagram lose only one.
  EXPECT_EQ(bits(losses({.pattern = LossPatternSpec{.times = {2'500us, 2'700us, 5ms}}}, 7)), "0001010");
  EXPECT_EQ(share(losses({.pattern = LossPatternSpec{.lost = 4, .of = 4}}, 100)), 1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto lost = losses({.pattern = LossPatternSpec{.lost = 3, .of = 10}}, 10'000, 1ms, seed);
    std::array<int, 10> place{};
    for (std::size_t window = 0; window < 1000; ++window) {
      const auto first = lost.begin() + static_cast<std::ptrdiff_t>(10 * window);
      ASSERT_EQ(std::count(first, first + 10, true), 3) << seed << " " << window;
      for (std::size_t i = 0; i < 10; ++i) place[i] += first[static_cast<std::ptrdiff_t>(i)] ? 1 : 0;
    }
    for (const int count : place) EXPECT_NEAR(count, 300, 5 * std::sqrt(210.0));
  }
}

TEST(LossTrace, RepeatsPerDatagramOrPerTime) {
  const auto trace = [](Duration interval) {
    return LossSpec{.trace = std::make_shared<LossTrace>(LossTrace{{true, false, false}, interval})};
  };
  EXPECT_EQ(bits(losses(trace({}), 7)), "1001001");
  EXPECT_EQ(bits(losses(trace(2ms), 8)), "11000011");
}

TEST(CongestionLoss, GrowsWithTheQueue) {
  // 128 + 28 bytes at 1 Mbit/s take 1.248 ms each, one per ms: the wait grows by 0.248 ms per accepted datagram.
  PathSpec spec;
  spec.rate.bits_per_s = 1'000'000;
  spec.loss.congestion = CongestionLossSpec{.wait_low = 10ms, .wait_high = 20ms, .probability = 1};
  const auto all = decisions(path_of(spec), 100'000);
  // Waits up to 10 ms cause no loss: 0.248 i <= 10 for i <= 40.
  for (std::size_t i = 0; i <= 40; ++i) ASSERT_EQ(all[i].outcome, Outcome::kDeliver) << i;
  // In equilibrium the sender is always busy and passes 1/1.248. The wait settles where 19.9 % are lost, at 12 ms.
  EXPECT_NEAR(static_cast<double>(count_of(all, Outcome::kLost)) / 100'000, 1 - 1 / 1.248, 0.002);
  EXPECT_NEAR(quantile(delays(all), 0.5) / 1e6, 12 + 1.248, 1);
  for (const double d : delays(all)) ASSERT_LE(d, 20e6 + 1.248e6);
}

TEST(CongestionLoss, DropsItsShareOfDatagramsInAStall) {
  PathSpec spec;
  spec.stall = {.rate_per_s = 2, .length_min = 50ms, .alpha = 3, .cap = 100ms};
  const auto free = decisions(path_of(spec), 200'000);
  spec.loss.congestion = CongestionLossSpec{.in_stall = 0.5};
  const auto lossy = decisions(path_of(spec), 200'000);
  std::size_t held = 0, lost = 0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const bool in_stall = free[i].at > Time{static_cast<std::int64_t>(i) * 1ms};
    if (!in_stall) {
      ASSERT_EQ(lossy[i].outcome, Outcome::kDeliver) << i;
    }
    held += in_stall ? 1 : 0;
    lost += lossy[i].outcome == Outcome::kLost ? 1 : 0;
  }
  EXPECT_GT(held, 10'000U);
  EXPECT_TRUE(binomial_fits(lost, held, 0.5));
}

LossSpec all_models() {
  LossSpec loss{.probability = 0.01};
  loss.periods = BadPeriodsSpec{.good_mean = 500ms, .bad_mean = 20ms};
  loss.gilbert_elliott = GilbertElliottSpec{.p = 0.05, .r = 0.2};
  loss.four_state = FourStateSpec{.p13 = 0.05, .p31 = 0.3, .p32 = 0.1, .p23 = 0.5, .p14 = 0.01};
  loss.bursts = LossBurstsSpec{0.5, Law::kParetoII, Unit::kDatagrams, 5, 1.5, 100};
  loss.pattern = LossPatternSpec{.lost = 1, .of = 100, .every = 77, .indices = {5}, .times = {1s}};
  loss.trace = std::make_shared<LossTrace>(LossTrace{{false, false, true}, 1s});
  return loss;
}

TEST(LossModels, AreIndependentOfEachOther) {
  const auto together = losses(all_models(), 20'000);
  LossSpec one[7];
  one[0].probability = all_models().probability;
  one[1].periods = all_models().periods;
  one[2].gilbert_elliott = all_models().gilbert_elliott;
  one[3].four_state = all_models().four_state;
  one[4].bursts = all_models().bursts;
  one[5].pattern = all_models().pattern;
  one[6].trace = all_models().trace;
  std::vector<bool> any(together.size());
  for (const LossSpec& alone : one) {
    const auto lost = losses(alone, any.size());
    EXPECT_GT(share(lost), 0);
    for (std::size_t i = 0; i < any.size(); ++i) any[i] = any[i] || lost[i];
  }
  EXPECT_EQ(together, any);
}

TEST(LossModels, KeepTheirDecisionsUnderAnOutage) {
  PathSpec plain, down;
  plain.loss = down.loss = all_models();
  down.outages = {{.start = 1s, .length = 500ms, .period = 2s}};
  const auto a = decisions(path_of(plain), 20'000), b = decisions(path_of(down), 20'000);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (b[i].outcome != Outcome::kOutage) {
      ASSERT_EQ(a[i].outcome, b[i].outcome) << i;
    }
  }
}

TEST(LossModels, TakeNoHeap) {
  PathSpec spec;
  spec.loss = all_models();
  Path path = path_of(spec);
  const tandem::test::AllocGuard guard;
  for (std::int64_t i = 0; i < 50'000; ++i) static_cast<void>(path.send(Time{i * 1ms}, kSize));
  EXPECT_EQ(guard.count(), 0U);
}

TEST(LossModels, ContradictionsAreNamed) {
  PathSpec spec;
  spec.loss.gilbert_elliott = GilbertElliottSpec{.p = 0, .r = 0, .h = 1, .k = 0.5};
  spec.loss.four_state = FourStateSpec{.p13 = 0.6, .p31 = 0, .p32 = 0.5, .p23 = 0, .p14 = 0.6};
  spec.loss.bursts = LossBurstsSpec{0, Law::kFixed, Unit::kDatagrams, 2.5, 1, 2};
  spec.loss.pattern = LossPatternSpec{.lost = 3, .of = 2, .indices = {4, 4}};
  spec.loss.congestion = CongestionLossSpec{.probability = 0.5, .in_stall = 0.5};
  spec.loss.trace = std::make_shared<LossTrace>();
  std::string keys;
  for (const SpecError& problem : problems(spec)) keys += problem.key.substr(5) + " ";
  EXPECT_EQ(keys,
            "gilbert_elliott.p gilbert_elliott.r gilbert_elliott.h four_state.p13 four_state.p31 four_state.p23 "
            "bursts.rate_per_s bursts.length bursts.length pattern.lost pattern.indices congestion.wait_high "
            "congestion.probability congestion.in_stall trace ");
}

TEST(LossModels, AreReadFromAProfile) {
  const auto profile = parse_profile(R"(
    version: 1
    both {
      rate { rate_bit_s: 1e6 } stall { rate_per_s: 1 length_min_ms: 1 alpha: 2 cap_ms: 5 }
      gilbert_elliott { p_percent: 1 r_percent: 25 h_percent: 10 k_percent: 99 }
      four_state { p13_percent: 5 p31_percent: 20 p32_percent: 30 p23_percent: 40 p14_percent: 2 }
      loss_bursts { rate_per_s: 2 law: PARETO_II length_ms: 20 alpha: 1.5 cap: 200 }
      loss_pattern { lost: 1 of: 10 every: 7 index: 3 index: 9 at_s: 1.5 }
      congestion_loss { wait_low_ms: 5 wait_high_ms: 10 queue_percent: 50 stall_percent: 20 }
      loss_trace { bits: "0010" interval_ms: 2 }
    })",
                                     "p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  const LossSpec& loss = profile->link.up.loss;
  EXPECT_EQ(loss.gilbert_elliott, (GilbertElliottSpec{0.01, 0.25, 0.1, 0.99}));
  EXPECT_EQ(loss.four_state, (FourStateSpec{0.05, 0.2, 0.3, 0.4, 0.02}));
  EXPECT_EQ(loss.bursts, (LossBurstsSpec{2, Law::kParetoII, Unit::kMilliseconds, 20, 1.5, 200}));
  EXPECT_EQ(loss.pattern, (LossPatternSpec{1, 10, 7, {3, 9}, {1500ms}}));
  EXPECT_EQ(loss.congestion, (CongestionLossSpec{5ms, 10ms, 0.5, 0.2}));
  ASSERT_TRUE(loss.trace);
  EXPECT_EQ(*loss.trace, (LossTrace{{false, false, true, false}, 2ms}));
}

TEST(LossModels, ReportThePlaceOfMistakesInAProfile) {
  const auto mistakes = [](std::string_view body) {
    const auto profile = parse_profile("version: 1\nboth {\n" + std::string(body) + "\n}\n", "p.textproto");
    return profile ? std::string("none") : to_text(profile.error());
  };
  const auto expect = [&](std::string_view body, std::string_view message) {
    const std::string text = mistakes(body);
    EXPECT_NE(text.find(message), std::string::npos) << body << "\n" << text;
  };
  expect("gilbert_elliott { p_percent: 1 r_percent: 0 }", "p.textproto:3:43: both.gilbert_elliott.r_percent = 0");
  expect("gilbert_elliott { p_percent: 1 r_percent: 5 h_percent: 70 k_percent: 60 }",
         "p.textproto:3:56: both.gilbert_elliott.h_percent = 70: is above");
  expect("four_state { p13_percent: 60 p14_percent: 50 }", "p.textproto:3:27: both.four_state.p13_percent = 60: with");
  expect("four_state { p13_percent: 6 p31_percent: 0 }", "p.textproto:3:42: both.four_state.p31_percent = 0: is 0");
  expect("loss_bursts { rate_per_s: -1 length_ms: 5 }", "p.textproto:3:27: both.loss_bursts.rate_per_s");
  expect("loss_bursts { rate_per_s: 1 }", "p.textproto:3:1: both.loss_bursts");
  expect("loss_bursts { rate_per_s: 1 law: GEOMETRIC length_ms: 5 }", "needs a cap");
  expect("loss_pattern { lost: 5 of: 4 }", "p.textproto:3:22: both.loss_pattern.lost = 5: is above");
  expect("loss_pattern { index: 5 index: 5 }", "p.textproto:3:32: both.loss_pattern.index[1] = 5: does not ascend");
  expect("congestion_loss { wait_high_ms: 5 queue_percent: 4 }",
         "p.textproto:3:50: both.congestion_loss.queue_percent");
  expect("loss_trace { bits: \"012\" }", "p.textproto:3:20: both.loss_trace.bits");
}

}  // namespace
}  // namespace tandem::netsim
