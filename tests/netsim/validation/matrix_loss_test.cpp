// Rows of the validation matrix about loss, reordering and duplicates; exact where the row is exact.
#include <gtest/gtest.h>

#include <cmath>

#include "netsim/models/loss.h"
#include "netsim/models/loss_models.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/support.h"
#include "tests/netsim/validation/statistics.h"

namespace tandem::netsim {
namespace {

using namespace test;

constexpr std::size_t kMillion = 1'000'000;

std::vector<bool> losses(const LossSpec& loss, std::size_t n, std::uint64_t seed) {
  PathSpec spec;
  spec.loss = loss;
  Path path = path_of(spec, seed);
  std::vector<bool> lost(n);
  for (std::size_t i = 0; i < n; ++i)
    lost[i] = path.send(Time{1ms * static_cast<std::int64_t>(i)}, kSize).outcome == Outcome::kLost;
  return lost;
}

/// Loss-rate test that every memoryless model must pass and netem's correlated loss must fail.
double loss_rate_p(const std::vector<bool>& lost, double p) {
  return binomial_p(static_cast<std::uint64_t>(std::count(lost.begin(), lost.end(), true)), lost.size(), p);
}

double share(const std::vector<bool>& lost) {
  return static_cast<double>(std::count(lost.begin(), lost.end(), true)) / static_cast<double>(lost.size());
}

TEST(Matrix, BernoulliLossIsBinomialInGeometricRuns) {
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    for (const double p : {1e-4, 0.01, 0.05, 0.5, 0.9}) {
      SCOPED_TRACE(::testing::Message() << "p " << p << ", seed " << seed);
      const auto lost = losses({.probability = p}, kMillion, seed);
      EXPECT_GT(loss_rate_p(lost, p), kAlpha);
      const auto losses_in_a_row = run_lengths(lost, true, 60), passes_in_a_row = run_lengths(lost, false, 60);
      if (p >= 0.01) {  // otherwise there are too few runs
        EXPECT_GT(chi_square_p(losses_in_a_row, geometric_shares(1 - p, 60)), kAlpha);
        EXPECT_GT(chi_square_p(passes_in_a_row, geometric_shares(p, 60)), kAlpha);
      }
    }
  }
}

// netem's "loss 5% 25%": a uniform value compressed to its middle, x = (1 - c) u + c x. The actual loss shares were
// computed separately; the loss-rate test must reject all of them.
TEST(Matrix, NetemsCorrelatedLossFailsTheLossRateTest) {
  struct Case {
    double p, c, really, within;
  };
  for (const Case& a : {Case{0.05, 0.25, 0.0020, 0.0002},
                        {0.10, 0.25, 0.018, 0.001},
                        {0.05, 0.50, 0.00001, 0.00002},
                        {0.30, 0.50, 0.128, 0.003}}) {
    SCOPED_TRACE(::testing::Message() << 100 * a.p << " % " << 100 * a.c << " %");
    RandomStream random{5};
    double x = random.uniform();
    std::vector<bool> lost(kMillion);
    for (std::size_t i = 0; i < lost.size(); ++i) {
      x = (1 - a.c) * random.uniform() + a.c * x;
      lost[i] = x < a.p;
    }
    EXPECT_LT(loss_rate_p(lost, a.p), kAlpha);
    EXPECT_NEAR(share(lost), a.really, a.within);
  }
  // Gilbert-Elliott with a mean burst of 4 is burstier than netem's model and keeps its 5 %.
  const double p = 0.05 / 0.95 * 0.25, r = 0.25, rho = 1 - p - r;
  const auto ours = losses({.gilbert_elliott = GilbertElliottSpec{.p = p, .r = r}}, kMillion, 5);
  EXPECT_NEAR(share(ours), 0.05, 4 * std::sqrt(0.05 * 0.95 / kMillion * (1 + rho) / (1 - rho)));
}

TEST(Matrix, GilbertElliottHasItsChancesItsShareAndItsBursts) {
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    for (const GilbertElliottSpec& spec : {GilbertElliottSpec{.p = 0.03, .r = 0.2},
                                           {.p = 0.001, .r = 0.5},
                                           {.p = 0.2, .r = 0.1},
                                           {.p = 0.02, .r = 0.25, .h = 0.4, .k = 0.99}}) {
      SCOPED_TRACE(::testing::Message() << "p " << spec.p << ", r " << spec.r << ", seed " << seed);
      GilbertElliott chain{spec, RandomKey{seed}};
      std::array<std::uint64_t, 2> from{}, changed{};
      std::vector<bool> bad(kMillion), lost(kMillion);
      bool before = chain.bad();
      for (std::size_t i = 0; i < kMillion; ++i) {
        lost[i] = chain.lost(i);
        bad[i] = chain.bad();
        ++from[before ? 1 : 0];
        changed[before ? 1 : 0] += bad[i] != before ? 1 : 0;
        before = bad[i];
      }
      const auto sigmas = [](std::uint64_t k, std::uint64_t n, double p) {
        return (static_cast<double>(k) - static_cast<double>(n) * p) / std::sqrt(static_cast<double>(n) * p * (1 - p));
      };
      const double most = seed == 1 ? 4 : 4.9;  // 4.9: 1e-6, for many seeds
      EXPECT_LT(std::abs(sigmas(changed[0], from[0], spec.p)), most);
      EXPECT_LT(std::abs(sigmas(changed[1], from[1], spec.r)), most);
      const double in_bad = spec.p / (spec.p + spec.r), rho = 1 - spec.p - spec.r;
      const double expected = (1 - in_bad) * (1 - spec.k) + in_bad * (1 - spec.h);
      // The state has correlation rho, but its losses are drawn independently. Only the variance between states is
      // scaled by rho.
      const double between = in_bad * (1 - in_bad) * std::pow(spec.k - spec.h, 2), all = expected * (1 - expected);
      const double variance = (all - between + between * (1 + rho) / (1 - rho)) / kMillion;
      EXPECT_LT(std::abs(share(lost) - expected), 4.9 * std::sqrt(variance));
      EXPECT_GT(chi_square_p(run_lengths(bad, true, 200), geometric_shares(spec.r, 200)), kAlpha);
      EXPECT_GT(chi_square_p(run_lengths(bad, false, 2000), geometric_shares(spec.p, 2000)), kAlpha);
    }
  }
}

// A continuous-time chain sampled every dt is a discrete chain with a known transition probability.
TEST(Matrix, ChangesBadPeriodsWithTheirProbabilityAtAnyStep) {
  const BadPeriodsSpec spec{.good_mean = 300ms, .bad_mean = 40ms, .loss_good = 0, .loss_bad = 1};
  const double in_bad = 40.0 / 340, rate_per_ms = 1 / 300.0 + 1 / 40.0;
  const std::size_t n = tandem::test::draws(200'000, kMillion, kMillion);
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    for (const int ms : {1, 10, 40, 200}) {
      SCOPED_TRACE(::testing::Message() << ms << " ms, seed " << seed);
      BadPeriods periods{spec, RandomKey{seed}};
      std::array<std::uint64_t, 2> from{}, changed{};
      bool before = periods.bad_at(Time{});
      for (std::size_t i = 1; i <= n; ++i) {
        const bool bad = periods.bad_at(Time{1ms * ms * static_cast<std::int64_t>(i)});
        ++from[before ? 1 : 0];
        changed[before ? 1 : 0] += bad != before ? 1 : 0;
        before = bad;
      }
      const double mixed = -std::expm1(-ms * rate_per_ms);
      EXPECT_GT(binomial_p(changed[0], from[0], in_bad * mixed), kAlpha);
      EXPECT_GT(binomial_p(changed[1], from[1], (1 - in_bad) * mixed), kAlpha);
    }
  }
}

// RFC 4737: the number of reordered datagrams equals the number chosen. Each arrives after exactly k later ones that
// were not chosen themselves.
TEST(Matrix, ReorderingHasExactlyItsRatioAndExtent) {
  const std::size_t n = tandem::test::draws(200'000, kMillion, kMillion);
  for (const auto& [q, k] : {std::pair{0.01, 3U}, {0.001, 1U}, {0.05, 10U}}) {
    SCOPED_TRACE(::testing::Message() << "q " << q << ", k " << k);
    PathSpec spec;
    spec.floor = 10ms;
    spec.reorder = {.probability = q, .displacement = k, .hold_limit = 60s};
    Path path = path_of(spec);
    std::uint64_t chosen = 0, let_go = 0;
    std::vector<std::uint64_t> passed(n);  // not chosen, up to and including each
    std::vector<bool> is_chosen(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Time now{1ms * static_cast<std::int64_t>(i)};
      const PathDecision v = path.send(now, kSize);
      is_chosen[i] = v.outcome == Outcome::kHeldBack;
      chosen += is_chosen[i] ? 1 : 0;
      passed[i] = (i == 0 ? 0 : passed[i - 1]) + (is_chosen[i] ? 0 : 1);
      for (const Release& r : v.released) {
        ASSERT_EQ(passed[i] - passed[r.index], k) << r.index;  // exactly k datagrams passed
        ASSERT_EQ(r.at, v.at) << r.index;
        ASSERT_TRUE(is_chosen[r.index]);
        ++let_go;
      }
    }
    EXPECT_GT(binomial_p(chosen, n, q), kAlpha);
    EXPECT_LE(chosen - let_go, 20U);  // those at the end still wait
  }
}

TEST(Matrix, CopiesABinomialShareOfDeliveredDatagramsNeverEarly) {
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    PathSpec spec;
    spec.loss.probability = 0.3;
    spec.body = {.kind = BodySpec::Kind::kUniform, .high = 8ms};
    spec.duplicate = {.probability = 0.02, .delay_max = 5ms};
    Path path = path_of(spec, seed);
    std::uint64_t delivered = 0, copies = 0;
    std::vector<double> delays;
    for (std::size_t i = 0; i < kMillion; ++i) {
      const PathDecision v = path.send(Time{1ms * static_cast<std::int64_t>(i)}, kSize);
      ASSERT_FALSE(v.copied && dropped(v.outcome)) << i;
      delivered += dropped(v.outcome) ? 0 : 1;
      if (!v.copied) continue;
      ++copies;
      ASSERT_GE(v.copy_delay, Duration::zero());
      delays.push_back(static_cast<double>(v.copy_delay.count()));
    }
    EXPECT_GT(binomial_p(delivered, kMillion, 0.7), kAlpha);
    EXPECT_GT(binomial_p(copies, delivered, 0.02), kAlpha);
    EXPECT_GT(ks_p(delays, [](double ns) { return ns / 5e6; }), kAlpha);
  }
}

}  // namespace
}  // namespace tandem::netsim
