// The tests' own tools against tables, hand-made numbers, and against wrong hypotheses: a tool that never fails proves
// nothing.
#include "tests/netsim/validation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "netsim/models/distributions.h"

namespace tandem::netsim::test {
namespace {

std::vector<double> uniforms(std::size_t n, std::uint64_t seed) {
  RandomStream random{seed};
  std::vector<double> u(n);
  for (double& value : u) value = random.uniform();
  return u;
}
double identity(double x) { return x; }

TEST(Statistics, BinomialTailsAreExact) {
  // 3 heads of 10: P(X <= 3) = 176/1024. 0 of 5 at 0.5: 1/32. 10 of 10 at 0.9: 0.9^10.
  EXPECT_NEAR(binomial_p(3, 10, 0.5), 2 * 176.0 / 1024, 1e-12);
  EXPECT_NEAR(binomial_p(0, 5, 0.5), 2.0 / 32, 1e-12);
  EXPECT_NEAR(binomial_p(10, 10, 0.9), 2 * std::pow(0.9, 10), 1e-12);
  // Large n: normal approximation, 5 sigma above the mean.
  EXPECT_NEAR(std::log(binomial_p(502'500, 1'000'000, 0.5)), std::log(normal_p(5)), 0.02);
  EXPECT_LT(binomial_p(2'000, 1'000'000, 0.05), 1e-100);
}

TEST(Statistics, MatchPublishedChiSquareTables) {
  const std::vector<double> halves{0.5, 0.5};
  EXPECT_NEAR(chi_square_p(std::vector<double>{550, 450}, halves), normal_p(std::sqrt(10.0)), 1e-12);
  EXPECT_NEAR(chi_square_p(std::vector<double>{500, 500}, halves), 1, 1e-12);
  // Small classes are merged: 9 and 1 of 10 form one class with the rest.
  EXPECT_EQ(chi_square_p(std::vector<double>{1, 2, 3}, std::vector<double>{0.2, 0.3, 0.5}), 0);
}

TEST(Statistics, AcceptTheTrueDistribution) {
  int ks_low = 0, ad_low = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    auto u = uniforms(1000, seed);
    ks_low += ks_p(u, identity) < 0.01 ? 1 : 0;
    ad_low += anderson_darling_p(u, identity) < 0.01 ? 1 : 0;
  }
  EXPECT_GT(binomial_p(static_cast<std::uint64_t>(ks_low), 1000, 0.01), 0.001) << ks_low;
  EXPECT_GT(binomial_p(static_cast<std::uint64_t>(ad_low), 1000, 0.01), 0.001) << ad_low;
}

TEST(Statistics, RejectAFalseDistribution) {
  auto u = uniforms(100'000, 4);
  EXPECT_LT(ks_p(u, [](double x) { return x * x; }), kAlpha);
  EXPECT_LT(anderson_darling_p(u, [](double x) { return std::pow(x, 1.05); }), kAlpha);
  // Slightly too heavy tails: AD detects them, KS does not.
  u = uniforms(1'000'000, 5);
  std::vector<double> z;
  for (std::size_t i = 0; i < u.size(); ++i) z.push_back(normal_quantile(open_unit(u[i])) * (i % 250 == 0 ? 5 : 1));
  EXPECT_GT(ks_p(z, normal_cdf), kAlpha);
  EXPECT_LT(anderson_darling_p(z, normal_cdf), kAlpha);
}

TEST(Statistics, ComputeCorrelationsAndRanks) {
  EXPECT_NEAR(correlation(std::vector<double>{1, 2, 3}, std::vector<double>{2, 4, 6}), 1, 1e-12);
  EXPECT_NEAR(correlation(std::vector<double>{1, -1, 1, -1}, std::vector<double>{1, 1, -1, -1}), 0, 1e-12);
  EXPECT_NEAR(autocorrelation(std::vector<double>{1, -1, 1, -1, 1, -1}, 1), -1, 1e-12);
  const auto z = rank_gaussian(std::vector<double>{30, 10, 20, 20});
  EXPECT_NEAR(z[1], normal_quantile(0.125), 1e-12);
  EXPECT_NEAR(z[2], 0, 1e-12);
  EXPECT_EQ(z[2], z[3]);
  EXPECT_NEAR(z[0], normal_quantile(0.875), 1e-12);
}

TEST(Statistics, CountRunsWithoutTruncatedOnes) {
  const std::vector<bool> bits{true, true, false, true, false, true, true, true, false, true};
  EXPECT_EQ(run_lengths(bits, true, 3), (std::vector<double>{1, 0, 1}));
  EXPECT_EQ(geometric_shares(0.5, 3), (std::vector<double>{0.5, 0.25, 0.25}));
}

}  // namespace
}  // namespace tandem::netsim::test
