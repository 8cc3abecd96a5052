// Rows of the validation matrix about distribution and correlation of delays, and about stalls.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "netsim/models/body_delay.h"
#include "netsim/models/delay_models.h"
#include "netsim/models/distributions.h"
#include "netsim/models/quantile_table.h"
#include "netsim/models/stalls.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/support.h"
#include "tests/netsim/validation/statistics.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Kind = BodySpec::Kind;

/// Delay distribution with a closed-form law, all in milliseconds.
struct Law {
  const char* name;
  BodySpec body;
  std::function<double(double)> cdf;
  double variance = 0;  ///< [ms^2]; 0: infinite, or its estimate converges too slowly
};

std::vector<Law> laws() {
  const double below = normal_cdf(-1.0), inside = normal_cdf(3.0) - below;
  // Truncated normal on [-1, 3] sigma: Var = s^2 (1 + (a phi(a) - b phi(b)) / Z - ((phi(a) - phi(b)) / Z)^2).
  const auto phi = [](double x) { return std::exp(-x * x / 2) / std::sqrt(2 * M_PI); };
  const double shift = (phi(-1) - phi(3)) / inside;
  const double truncated = 4 * (1 + (-phi(-1) - 3 * phi(3)) / inside - shift * shift);
  const double m1 = 0.75 * 4 + 0.25 * 12, m2 = 2 * (0.75 * 16 + 0.25 * 144);
  return {
      {"uniform",
       {.kind = Kind::kUniform, .low = 2ms, .high = 7ms},
       [](double x) { return std::clamp((x - 2) / 5, 0.0, 1.0); },
       25.0 / 12},
      {"log-normal",
       {.kind = Kind::kLogNormal, .scale = 5ms, .shape = 0.4, .cap = 60s},
       [](double x) { return x <= 0 ? 0 : normal_cdf(std::log(x / 5) / 0.4); },
       25 * std::exp(0.16) * (std::exp(0.16) - 1)},
      {"log-logistic",
       {.kind = Kind::kLogLogistic, .scale = 750us, .shape = 2.4, .cap = 60s},
       [](double x) { return x <= 0 ? 0 : 1 / (1 + std::pow(x / 0.75, -2.4)); }},
      {"truncated normal",
       {.kind = Kind::kTruncatedNormal, .low = 3ms, .scale = 5ms, .cap = 11ms, .sd = 2ms},
       [=](double x) { return std::clamp((normal_cdf((x - 5) / 2) - below) / inside, 0.0, 1.0); },
       truncated},
      {"exponential",
       {.kind = Kind::kExponential, .scale = 4ms, .cap = 60s},
       [](double x) { return -std::expm1(-x / 4); },
       16},
      {"gamma 2",
       {.kind = Kind::kGamma, .scale = 2ms, .shape = 2, .cap = 60s},
       [](double x) { return gamma_p(2, x / 2); },
       8},
      {"gamma 0.7",
       {.kind = Kind::kGamma, .scale = 3ms, .shape = 0.7, .cap = 60s},
       [](double x) { return gamma_p(0.7, x / 3); },
       6.3},
      {"hyper-exponential",
       {.kind = Kind::kHyperExponential, .cap = 60s, .phases = {{0.75, 4ms}, {0.25, 12ms}}},
       [](double x) { return -0.75 * std::expm1(-x / 4) - 0.25 * std::expm1(-x / 12); },
       m2 - m1 * m1},
      {"Pareto",
       {.kind = Kind::kPareto, .scale = 3ms, .shape = 1.5, .cap = 60s},
       [](double x) { return x < 3 ? 0 : 1 - std::pow(x / 3, -1.5); }},
      {"empirical",
       {.kind = Kind::kEmpirical, .quantiles = {{0, 1ms}, {0.5, 2ms}, {1, 10ms}}},
       [](double x) { return std::clamp(x < 2 ? (x - 1) / 2 : 0.5 + (x - 2) / 16, 0.0, 1.0); },
       // Halves uniform on [1, 2] and [2, 10]: E = 3.75, E[x^2] = (7/3 + 124/3) / 2.
       (7.0 / 3 + 124.0 / 3) / 2 - 3.75 * 3.75},
  };
}

/// Returns milliseconds of one body, sampled every `period`, with ArrivalOrder::kFree (the process that the parameters
/// describe).
std::vector<double> drawn(BodySpec spec, std::size_t n, Duration tau, Duration period, std::uint64_t seed) {
  spec.tau = tau;
  BodyDelay body{spec, RandomKey{seed}.derive(77)};
  std::vector<double> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = 1e3 * seconds(body.at(Time{period * static_cast<std::int64_t>(i)}, i));
  return all;
}

TEST(Matrix, MatchesTheDistributionOfDelays) {
  const std::size_t n = tandem::test::draws(200'000, 1'000'000, 1'000'000);
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    for (const Law& law : laws()) {
      SCOPED_TRACE(std::string(law.name) + ", seed " + std::to_string(seed));
      auto samples = drawn(law.body, n, {}, 1ms, seed);
      EXPECT_GT(ks_p(samples, law.cdf), kAlpha);
      EXPECT_GT(anderson_darling_p(samples, law.cdf), kAlpha);
    }
  }
}

// Shows that the tests above can fail: one percent of a shape, and tails cut at 4 sigma as in netem's tables.
TEST(Matrix, DetectsASlightlyWrongDistribution) {
  const auto all = laws();
  auto body = all[1].body;
  body.shape = 0.404;
  auto samples = drawn(body, 1'000'000, {}, 1ms, 1);
  EXPECT_LT(anderson_darling_p(samples, all[1].cdf), kAlpha);
  body = all[4].body;
  body.cap = 22ms;  // of a mean of 4: one in 245 values is cut off
  samples = drawn(body, 1'000'000, {}, 1ms, 1);
  EXPECT_LT(ks_p(samples, all[4].cdf), kAlpha);
}

TEST(Matrix, KeepsTheDistributionUnderCorrelation) {
  const std::size_t n = tandem::test::draws(50'000, 100'000, 100'000);
  for (std::uint64_t seed = 1, last = tandem::test::seeds(1); seed <= last; ++seed) {
    for (const Law& law : laws()) {
      SCOPED_TRACE(std::string(law.name) + ", seed " + std::to_string(seed));
      auto samples = drawn(law.body, n, 10ms, 137ms, seed);  // more than ten correlation times apart
      EXPECT_GT(ks_p(samples, law.cdf), kAlpha);
      EXPECT_GT(anderson_darling_p(samples, law.cdf), kAlpha);
    }
  }
}

TEST(Matrix, KeepsTheVarianceWithinOnePercentUnderCorrelation) {
  // 1 % is 3.5 standard errors of the worst of these (hyper-exponential, kurtosis 11) at 1e6 samples.
  for (const Law& law : laws()) {
    if (law.variance == 0) continue;
    SCOPED_TRACE(law.name);
    const auto samples = drawn(law.body, 1'000'000, 10ms, 101ms, 3);
    double sum = 0, squares = 0;
    for (const double x : samples) sum += x;
    const double mean = sum / static_cast<double>(samples.size());
    for (const double x : samples) squares += (x - mean) * (x - mean);
    EXPECT_NEAR(squares / static_cast<double>(samples.size()) / law.variance, 1, 0.01);
  }
}

TEST(Matrix, DecaysCorrelationWithItsTime) {
  const auto taus = static_cast<std::size_t>(tandem::test::draws(20'000, 100'000, 100'000));
  for (const Law& law : laws()) {
    SCOPED_TRACE(law.name);
    auto z = drawn(law.body, 2 * taus, 20ms, 10ms, 11);  // two samples per tau
    for (double& x : z) x = normal_quantile(std::clamp(law.cdf(x), 1e-12, 1 - 1e-12));
    for (const std::size_t lag : {1U, 2U, 4U, 8U}) {  // 0.5, 1, 2, 4 tau
      EXPECT_NEAR(autocorrelation(z, lag), std::exp(-0.5 * static_cast<double>(lag)), 0.03)
          << 0.5 * static_cast<double>(lag) << " tau";
    }
  }
}

/// 1 kHz datagrams and a stall from `begin` for `length`: ceil(length / 1 ms) datagrams leave at its end. Their delays
/// are length, length - 1 ms, ... if the first is sent exactly at the begin.
void expect_sawtooth(const PathSpec& spec, Time begin, Duration length) {
  const auto all = decisions(path_of(spec), 3000);
  const auto first = static_cast<std::size_t>((begin - Time{}) / 1ms);
  const auto held = static_cast<std::size_t>((length + 1ms - 1ns) / 1ms);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Time sent{1ms * static_cast<std::int64_t>(i)};
    const bool inside = i >= first && i < first + held;
    ASSERT_EQ(all[i].at - sent, inside ? length - 1ms * static_cast<std::int64_t>(i - first) : Duration::zero()) << i;
  }
}

TEST(Matrix, ReleasesAStallAtOneInstant) {
  for (const Duration length : {Duration{1ms}, Duration{80ms}, Duration{80'400us}, Duration{399'999'999ns}}) {
    SCOPED_TRACE(::testing::Message() << length.count() << " ns");
    PathSpec outage;
    outage.outages = {{.start = 1s, .length = length, .mode = OutageSpec::Mode::kHold}};
    expect_sawtooth(outage, Time{1s}, length);
    PathSpec boundary;
    boundary.boundary = {.period = 10s, .phase = 500ms, .stall_low = length, .stall_high = length};
    expect_sawtooth(boundary, Time{500ms}, length);
  }
}

TEST(Matrix, ReleasesARandomStallAtOneInstant) {
  // Stalls of exactly 80.4 ms, so rare that they hardly overlap: every interval of equal times is one stall.
  PathSpec spec;
  spec.stall = {.rate_per_s = 0.2, .length_min = 80'400us, .alpha = 1, .cap = 80'400us};
  for (std::uint64_t seed = 1, last = tandem::test::seeds(3); seed <= last; ++seed) {
    const auto all = decisions(path_of(spec, seed), 200'000);
    std::size_t stalls = 0, joined = 0;
    for (std::size_t i = 0; i < all.size();) {
      const Time sent{1ms * static_cast<std::int64_t>(i)}, end = all[i].at;
      if (end == sent) {
        ++i;
        continue;
      }
      std::size_t together = 0;
      for (; i < all.size() && all[i].at == end; ++i, ++together)
        ASSERT_EQ(all[i].at - Time{1ms * static_cast<std::int64_t>(i)},
                  end - sent - 1ms * static_cast<std::int64_t>(together));
      ++stalls;
      if (end - sent > 80'400us) {
        ++joined;
        continue;
      }
      ASSERT_EQ(together, static_cast<std::size_t>((end - sent + 1ms - 1ns) / 1ms));  // ceil of the remaining time
      ASSERT_TRUE(i == all.size() || together == 80 || together == 81) << together;
    }
    EXPECT_GT(normal_p((static_cast<double>(stalls + joined) - 40) / std::sqrt(40.0)), kAlpha)
        << stalls;  // 0.2 per s in 200 s
    EXPECT_LT(joined, 10U);
  }
}

}  // namespace
}  // namespace tandem::netsim
