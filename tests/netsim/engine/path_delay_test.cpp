// Floor, body and order: arrival times of datagrams.
#include <gtest/gtest.h>

#include <cmath>

#include "netsim/engine/path.h"
#include "netsim/models/distributions.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Kind = BodySpec::Kind;

TEST(Path, DeliversAtTheSameInstantWithoutModels) {
  Path path = path_of({});
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1500}, std::size_t{65'507}}) {
    const PathDecision v = path.send(Time{5ms}, size);
    EXPECT_EQ(v.outcome, Outcome::kDeliver);
    EXPECT_EQ(v.at, Time{5ms});
    EXPECT_FALSE(v.copied);
    EXPECT_TRUE(v.released.empty());
  }
}

TEST(Path, AddsTheFloorExactly) {
  for (const Duration floor : {Duration{}, Duration{1ns}, Duration{20ms}, Duration{60s}}) {
    PathSpec spec;
    spec.floor = floor;
    EXPECT_EQ(path_of(spec).send(Time{3s}, kSize).at, Time{3s} + floor);
  }
}

TEST(Path, TreatsDecreasingTimeAsTheLatest) {
  Path path = path_of({});
  EXPECT_EQ(path.send(Time{10ms}, kSize).at, Time{10ms});
  EXPECT_EQ(path.send(Time{4ms}, kSize).at, Time{10ms});
  Path early = path_of({});
  EXPECT_EQ(early.send(Time{-5s}, kSize).at, Time{});
  EXPECT_EQ(early.send(Time::max(), kSize).outcome, Outcome::kDeliver);
}

BodySpec body_of(Kind kind, Duration tau = {}) {
  BodySpec body{.kind = kind, .low = 2ms, .high = 7ms, .scale = 5ms, .shape = 0.75, .cap = 60s, .tau = tau};
  if (kind == Kind::kLogLogistic) body.shape = 2.4;
  return body;
}
double cdf(Kind kind, double ns) {
  const double ms = ns / 1e6;
  if (kind == Kind::kUniform) return std::clamp((ms - 2) / 5, 0.0, 1.0);
  if (ms <= 0) return 0;
  if (kind == Kind::kLogNormal) return normal_cdf(std::log(ms / 5) / 0.75);
  return 1 / (1 + std::pow(ms / 5, -2.4));
}

TEST(Body, HasItsDistributionWhenEveryDatagramDraws) {
  for (const Kind kind : {Kind::kUniform, Kind::kLogNormal, Kind::kLogLogistic}) {
    PathSpec spec;
    spec.body = body_of(kind);
    spec.order = ArrivalOrder::kFree;
    const auto samples = delays(decisions(path_of(spec), 1'000'000));
    EXPECT_LT(ks_distance(samples, [kind](double ns) { return cdf(kind, ns); }), 0.0027) << static_cast<int>(kind);
  }
}

TEST(Body, KeepsItsDistributionWhenCorrelated) {
  for (const Kind kind : {Kind::kUniform, Kind::kLogNormal, Kind::kLogLogistic}) {
    PathSpec spec;
    spec.body = body_of(kind, 3ms);
    spec.order = ArrivalOrder::kFree;
    const auto samples = delays(decisions(path_of(spec), 100'000, 31ms), 31ms);  // more than 10 tau apart
    EXPECT_LT(ks_distance(samples, [kind](double ns) { return cdf(kind, ns); }), 0.0086) << static_cast<int>(kind);
  }
}

TEST(Body, IsIndependentOfTheRateWhenCorrelated) {
  PathSpec spec;
  spec.body = body_of(Kind::kLogNormal, 20ms);
  spec.order = ArrivalOrder::kFree;
  const auto fast = decisions(path_of(spec), 20'000, 1ms);
  const auto slow = decisions(path_of(spec), 1'000, 20ms);
  for (std::size_t i = 0; i < slow.size(); ++i) ASSERT_EQ(slow[i].at, fast[20 * i].at) << i;
}

TEST(Body, NeverExceedsItsCap) {
  PathSpec spec;
  spec.body = body_of(Kind::kLogLogistic);
  spec.body.cap = 9ms;
  spec.order = ArrivalOrder::kFree;
  const auto samples = delays(decisions(path_of(spec), 100'000));
  EXPECT_EQ(*std::max_element(samples.begin(), samples.end()), 9e6);
}

TEST(Order, FifoIsTheRunningMaximumOfFree) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    PathSpec spec;
    spec.floor = 3ms;
    spec.body = body_of(Kind::kLogNormal, seed % 2 == 0 ? Duration{10ms} : Duration{});
    spec.stall = {.rate_per_s = 2, .length_min = 5ms, .alpha = 1.5, .cap = 100ms};
    PathSpec free = spec;
    free.order = ArrivalOrder::kFree;
    const auto fifo = decisions(path_of(spec, seed), 5'000);
    const auto raw = decisions(path_of(free, seed), 5'000);
    Time latest{};
    for (std::size_t i = 0; i < fifo.size(); ++i) {  // max-plus recursion, computed independently
      latest = std::max(latest, raw[i].at);
      ASSERT_EQ(fifo[i].at, latest) << i;
    }
  }
}

TEST(Order, FreeReordersAtOneKilohertz) {
  PathSpec spec;
  spec.body = {.kind = Kind::kUniform, .high = 5ms};
  spec.order = ArrivalOrder::kFree;
  const auto all = decisions(path_of(spec), 10'000);
  std::size_t late = 0;
  for (std::size_t i = 1; i < all.size(); ++i) late += all[i].at < all[i - 1].at ? 1 : 0;
  EXPECT_GT(late, 2'000U);
}

TEST(Path, DeliversNothingBeforeTheFloor) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    PathSpec spec = everything();
    spec.order = seed % 2 == 0 ? ArrivalOrder::kFree : ArrivalOrder::kFifo;
    Path path = path_of(spec, seed);
    for (int i = 0; i < 5'000; ++i) {
      const Time now{i * 700us};
      const PathDecision v = path.send(now, kSize);
      ASSERT_TRUE(dropped(v.outcome) || v.at - now >= spec.floor) << i;
      for (const Release& r : v.released)
        ASSERT_GE(r.at, Time{static_cast<std::int64_t>(r.index) * 700us} + spec.floor);
    }
  }
}

TEST(Path, AddsUniformJitterForTheShorthand) {
  const LinkSpec link = link_from({.delay = 20ms, .jitter = 5ms, .loss = 0.05});
  EXPECT_EQ(link.up, link.down);
  const auto all = decisions(path_of(link.up), 100'000);
  const auto samples = delays(all);
  EXPECT_GE(*std::min_element(samples.begin(), samples.end()), 20e6);
  EXPECT_LE(*std::max_element(samples.begin(), samples.end()), 25e6);
  EXPECT_TRUE(binomial_fits(count_of(all, Outcome::kLost), all.size(), 0.05));
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                             [](const PathDecision& a, const PathDecision& b) { return a.at < b.at; }) ||
              count_of(all, Outcome::kLost) > 0);
}

}  // namespace
}  // namespace tandem::netsim
