#include "netsim/models/loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

PathSpec bernoulli(double p) {
  PathSpec spec;
  spec.loss.probability = p;
  return spec;
}

TEST(Loss, NoneAndAllAreExact) {
  EXPECT_EQ(count_of(decisions(path_of(bernoulli(0)), 100'000), Outcome::kLost), 0U);
  EXPECT_EQ(count_of(decisions(path_of(bernoulli(1)), 100'000), Outcome::kLost), 100'000U);
}

TEST(Loss, BernoulliLosesItsShareInGeometricRuns) {
  constexpr std::size_t n = 1'000'000;
  const double p = 0.05;
  const auto all = decisions(path_of(bernoulli(p), 3), n);
  EXPECT_TRUE(binomial_fits(count_of(all, Outcome::kLost), n, p));
  // Number of loss runs of length k: n (1-p)^2 p^k.
  std::array<double, 4> runs{};
  std::size_t run = 0;
  for (const PathDecision& v : all) {
    if (v.outcome == Outcome::kLost) {
      ++run;
    } else {
      if (run >= 1 && run <= runs.size()) ++runs[run - 1];
      run = 0;
    }
  }
  for (std::size_t k = 1; k <= runs.size(); ++k) {
    const double expected = n * (1 - p) * (1 - p) * std::pow(p, static_cast<double>(k));
    EXPECT_NEAR(runs[k - 1], expected, 5 * std::sqrt(expected)) << k;
  }
}

// Shows that the test can fail: netem's correlated loss, (1 - c) u + c x_last, loses 0.2 % instead of 5 %.
TEST(Loss, DetectsTheBiasOfNetemsCorrelation) {
  RandomStream random{5};
  double x = random.uniform();
  std::size_t lost = 0;
  constexpr std::size_t n = 1'000'000;
  for (std::size_t i = 0; i < n; ++i) {
    x = 0.75 * random.uniform() + 0.25 * x;
    lost += x < 0.05 ? 1 : 0;
  }
  EXPECT_FALSE(binomial_fits(lost, n, 0.05));
  EXPECT_NEAR(static_cast<double>(lost) / n, 0.002, 0.0005);
}

constexpr BadPeriodsSpec kPeriods{.good_mean = 300ms, .bad_mean = 40ms, .loss_good = 0, .loss_bad = 1};

TEST(BadPeriods, AreIndependentOfTheRate) {
  PathSpec spec;
  spec.loss.periods = kPeriods;
  constexpr std::int64_t kMilliseconds = 200'000;
  const auto lost_at = [&](std::int64_t period_ms) {
    Path path = path_of(spec, 9);
    std::vector<bool> lost;
    for (std::int64_t t = 0; t < kMilliseconds; t += period_ms) {
      lost.push_back(path.send(Time{t * 1ms}, kSize).outcome == Outcome::kLost);
    }
    return lost;
  };
  const auto every_ms = lost_at(1);
  ASSERT_GT(std::count(every_ms.begin(), every_ms.end(), true), 1000);
  for (const std::int64_t period_ms : {2, 10, 20}) {  // 500, 100, 50 Hz
    const auto slower = lost_at(period_ms);
    for (std::size_t i = 0; i < slower.size(); ++i) {
      ASSERT_EQ(slower[i], every_ms[i * static_cast<std::size_t>(period_ms)]) << period_ms << " ms, " << i;
    }
  }
}

TEST(BadPeriods, HaveTheShareAndLengthsOfTheSpec) {
  BadPeriods periods{kPeriods, RandomKey{4}};
  Time t{};
  double bad_s = 0, good_s = 0;
  std::size_t bad_count = 0;
  std::vector<double> bad_lengths;
  Time bad_since{};
  bool was_bad = false;
  for (int i = 0; i < 40'000; ++i) {
    const bool bad = periods.bad_at(t);
    const Time end = periods.period_end();
    (bad ? bad_s : good_s) += seconds(end - t);
    if (bad && !was_bad) bad_since = t;
    if (!bad && was_bad) {
      bad_lengths.push_back(seconds(t - bad_since));
      ++bad_count;
    }
    was_bad = bad;
    t = end;
  }
  EXPECT_NEAR(bad_s / (bad_s + good_s), 40.0 / 340, 0.003);
  EXPECT_LT(ks_distance(bad_lengths, [](double x) { return 1 - std::exp(-x / 0.040); }),
            2.7 / std::sqrt(static_cast<double>(bad_count)));
}

TEST(BadPeriods, TransitionFollowsTheClosedForm) {
  // P(bad at t + dt | good at t) = share (1 - exp(-dt (1/good + 1/bad)))
  const double share = 40.0 / 340;
  for (const double dt : {0.005, 0.04, 0.2}) {
    BadPeriods periods{kPeriods, RandomKey{21}};
    std::size_t good = 0, turned = 0;
    bool before = periods.bad_at(Time{});
    for (int i = 1; i < 400'000; ++i) {
      const bool now = periods.bad_at(Time{from_seconds(dt * i)});
      good += before ? 0 : 1;
      turned += !before && now ? 1 : 0;
      before = now;
    }
    const double expected = share * (1 - std::exp(-dt * (1 / 0.3 + 1 / 0.04)));
    EXPECT_TRUE(binomial_fits(turned, good, expected)) << dt;
  }
}

TEST(BadPeriods, ReachTheSameStateAfterAJumpOfYears) {
  const Time far{std::chrono::hours(24 * 365 * 10) + 123ms};
  BadPeriods jumped{kPeriods, RandomKey{6}};
  const bool after_jump = jumped.bad_at(far);
  BadPeriods walked{kPeriods, RandomKey{6}};
  for (int i = 1000; i >= 0; --i) static_cast<void>(walked.bad_at(far - i * 100ms));
  EXPECT_EQ(walked.bad_at(far), after_jump);
  EXPECT_EQ(walked.period_end(), jumped.period_end());
}

TEST(BadPeriods, LoseTheirOwnShareInEachState) {
  PathSpec spec;
  spec.loss.periods = BadPeriodsSpec{.good_mean = 100ms, .bad_mean = 100ms, .loss_good = 0.1, .loss_bad = 0.7};
  constexpr std::size_t n = 400'000;
  const double share = static_cast<double>(count_of(decisions(path_of(spec), n), Outcome::kLost)) / n;
  EXPECT_NEAR(share, 0.4, 0.01);  // n_eff = 400 s / 0.1 s periods: sigma 0.3 * sqrt(1/4000) = 0.005
}

TEST(LossSpec, EqualRecordingsAreEqualWhereverTheyWereRead) {
  const auto read = [](std::vector<bool> lost) {
    return LossSpec{.trace = std::make_shared<LossTrace>(LossTrace{std::move(lost), 1ms})};
  };
  EXPECT_EQ(read({false, true}), read({false, true}));
  EXPECT_NE(read({false, true}), read({true, false}));
  EXPECT_NE(read({false, true}), LossSpec{});
  EXPECT_NE(LossSpec{}, read({false, true}));
  const LossSpec one = read({true}), copy = one;
  EXPECT_EQ(one, copy);
}

}  // namespace
}  // namespace tandem::netsim
