// Body distributions other than the first three; regimes, boundary, slots, competing flow.
#include "netsim/models/delay_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "netsim/models/distributions.h"
#include "netsim/models/quantile_table.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Kind = BodySpec::Kind;

struct Case {
  BodySpec body;
  std::function<double(double)> cdf;  ///< argument in milliseconds
};

std::vector<Case> cases() {
  const auto hyper = [](double x) { return 0.73 * (1 - std::exp(-x * 0.027)) + 0.27 * (1 - std::exp(-x * 0.085)); };
  const double below = normal_cdf(-1.0), inside = normal_cdf(3.0) - below;
  return {
      {{.kind = Kind::kTruncatedNormal, .low = 3ms, .scale = 5ms, .cap = 11ms, .sd = 2ms},
       [=](double x) { return std::clamp((normal_cdf((x - 5) / 2) - below) / inside, 0.0, 1.0); }},
      {{.kind = Kind::kExponential, .scale = 4ms, .cap = 60s}, [](double x) { return 1 - std::exp(-x / 4); }},
      {{.kind = Kind::kGamma, .scale = 2ms, .shape = 2, .cap = 60s},
       [](double x) { return 1 - std::exp(-x / 2) * (1 + x / 2); }},
      {{.kind = Kind::kGamma, .scale = 2ms, .shape = 0.5, .cap = 60s},
       [](double x) { return std::erf(std::sqrt(x / 2)); }},
      {{.kind = Kind::kHyperExponential,
        .cap = 60s,
        .phases = {{0.73, from_seconds(1e-3 / 0.027)}, {0.27, from_seconds(1e-3 / 0.085)}}},
       hyper},
      {{.kind = Kind::kPareto, .scale = 3ms, .shape = 1.5, .cap = 60s},
       [](double x) { return x < 3 ? 0 : 1 - std::pow(x / 3, -1.5); }},
      {{.kind = Kind::kEmpirical, .quantiles = {{0, 1ms}, {0.5, 2ms}, {1, 10ms}}},
       [](double x) { return std::clamp(x < 2 ? (x - 1) / 2 : 0.5 + (x - 2) / 16, 0.0, 1.0); }},
  };
}

/// Returns delays in milliseconds with ArrivalOrder::kFree, so that datagrams do not affect each other.
std::vector<double> drawn(BodySpec body, std::size_t n, Duration tau, Duration period, std::uint64_t seed) {
  PathSpec spec;
  body.tau = tau;
  spec.body = body;
  spec.order = ArrivalOrder::kFree;
  auto all = delays(decisions(path_of(spec, seed), n, period), period);
  for (double& d : all) d /= 1e6;
  return all;
}

TEST(BodyKinds, HaveTheirDistributionWithAndWithoutCorrelation) {
  for (std::uint64_t seed = 1; seed <= tandem::test::seeds(1); ++seed) {
    for (const Case& c : cases()) {
      SCOPED_TRACE(static_cast<int>(c.body.kind));
      constexpr std::size_t n = 300'000, spaced = 50'000;
      EXPECT_LT(ks_distance(drawn(c.body, n, {}, 1ms, seed), c.cdf), 2.7 / std::sqrt(n));
      // Correlated body, sampled every ten correlation times.
      EXPECT_LT(ks_distance(drawn(c.body, spaced, 10ms, 100ms, seed), c.cdf), 2.7 / std::sqrt(spaced));
    }
  }
}

TEST(BodyKinds, KeepTheirCorrelationTime) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(static_cast<int>(c.body.kind));
    const auto x = drawn(c.body, 200'000, 20ms, 1ms, 11);
    std::vector<double> z;
    for (const double ms : x) z.push_back(normal_quantile(std::clamp(c.cdf(ms), 1e-9, 1 - 1e-9)));
    for (const std::size_t lag : {10U, 20U, 40U}) {
      double sum = 0, square = 0;
      for (std::size_t i = 0; i + lag < z.size(); ++i) sum += z[i] * z[i + lag];
      for (const double v : z) square += v * v;
      EXPECT_NEAR(sum / square, std::exp(-static_cast<double>(lag) / 20), 0.06) << lag;
    }
  }
}

TEST(BodyKinds, StayBetweenFloorAndCap) {
  for (Case c : cases()) {
    if (c.body.kind != Kind::kEmpirical) c.body.cap = 8ms;
    const double cap = seconds(c.body.longest()) * 1e3;
    for (const double ms : drawn(c.body, 50'000, {}, 1ms, 3)) {
      ASSERT_GE(ms, 0);
      ASSERT_LE(ms, cap);
    }
  }
}

TEST(QuantileTable, MatchesPublishedGammaTables) {
  EXPECT_NEAR(gamma_p(1, 2), 1 - std::exp(-2.0), 1e-14);
  EXPECT_NEAR(gamma_q(0.5, 8), std::erfc(std::sqrt(8.0)), 1e-17);
  EXPECT_NEAR(gamma_p(100, 100) + gamma_q(100, 100), 1, 1e-14);
  EXPECT_EQ(gamma_p(2, 0), 0);
}

TEST(Regimes, SpendTheirShareAndAddTheirFloor) {
  PathSpec spec;
  spec.order = ArrivalOrder::kFree;
  spec.regimes = {{.mean = 100ms}, {.mean = 300ms, .floor = 5ms}, {.mean = 600ms, .floor = 9ms}};
  std::map<double, double> share;
  constexpr std::size_t n = 4'000'000;
  for (const double d : delays(decisions(path_of(spec), n))) share[d / 1e6] += 1.0 / n;
  ASSERT_EQ(share.size(), 3U);
  EXPECT_NEAR(share[0], 0.1, 0.01);
  EXPECT_NEAR(share[5], 0.3, 0.02);
  EXPECT_NEAR(share[9], 0.6, 0.02);
}

TEST(Regimes, AreAFunctionOfTime) {
  const std::vector<RegimeSpec> specs{{.mean = 50ms}, {.mean = 20ms, .floor = 1ms}};
  Regimes every{specs, RandomKey{4}}, seldom{specs, RandomKey{4}};
  std::size_t changes = 0, before = 0;
  for (int i = 0; i < 200'000; ++i) {
    const std::size_t state = every.state_at(Time{i * 1ms});
    changes += state != before ? 1 : 0;
    before = state;
    if (i % 37 == 0) {
      ASSERT_EQ(seldom.state_at(Time{i * 1ms}), state) << i;
    }
  }
  EXPECT_NEAR(static_cast<double>(changes), 200'000 / 35.0, 500);
}

TEST(Boundary, HoldsLosesAndShiftsAtItsTimes) {
  PathSpec spec;
  spec.floor = 10ms;
  spec.boundary = {.period = 1s, .phase = 500ms, .stall_low = 40ms, .stall_high = 40ms};
  const auto all = decisions(path_of(spec), 2000);
  EXPECT_EQ(all[489].at, Time{499ms});                                         // leaves just before the stall
  for (std::size_t i = 490; i <= 530; ++i) ASSERT_EQ(all[i].at, Time{540ms});  // all at the end of the stall
  EXPECT_EQ(all[531].at, Time{541ms});
  EXPECT_EQ(all[1490].at, Time{1540ms});
  spec.boundary = {.period = 1s, .phase = 500ms, .loss_window = 20ms, .loss = 1};
  const auto lossy = decisions(path_of(spec), 2000);
  for (std::size_t i = 0; i < lossy.size(); ++i) {
    const bool inside = (i >= 500 && i < 520) || (i >= 1500 && i < 1520);
    ASSERT_EQ(lossy[i].outcome == Outcome::kLost, inside) << i;
  }
  spec.boundary = {.period = 100ms, .floor_high = 20ms};
  spec.order = ArrivalOrder::kFree;
  std::set<double> floors;
  for (const double d : delays(decisions(path_of(spec), 100'000))) floors.insert(d / 1e6);
  EXPECT_EQ(floors.size(), 1000U);  // one value per period
  EXPECT_LT(ks_distance({floors.begin(), floors.end()}, [](double x) { return (x - 10) / 20; }), 2.7 / std::sqrt(1000));
}

TEST(Slots, PutALimitedNumberOfDeparturesOnEachGridPoint) {
  PathSpec spec;
  spec.slots = {.period = 5ms};
  const auto free = decisions(path_of(spec), 20);
  for (std::size_t i = 0; i < free.size(); ++i) {
    EXPECT_EQ(free[i].at, Time{5ms * static_cast<std::int64_t>((i + 4) / 5)}) << i;
  }
  Slots two{{.period = 5ms, .datagrams = 2}};
  for (const int at : {0, 0, 5, 5, 10}) EXPECT_EQ(two.release(Time{}, 100), Time{at * 1ms});
  Slots bytes{{.period = 5ms, .bytes = 250}};
  for (const int at : {0, 0, 5, 5, 10}) EXPECT_EQ(bytes.release(Time{}, 100), Time{at * 1ms});
  EXPECT_EQ(bytes.release(Time{}, 900), Time{15ms});  // larger than a slot: alone in its slot
  EXPECT_EQ(bytes.release(Time{21ms}, 1), Time{25ms});
}

TEST(CompetingFlow, FillsTheQueueAndLetsItDrain) {
  // 100 bytes at 800 kbit/s take 1 ms. Peak 40 ms in a period of 100 ms: 60 ms rising, 40 ms falling.
  LinkRate rate{{.bits_per_s = 800'000, .overhead_bytes = 0, .competing_peak = 40ms, .competing_period = 100ms}};
  EXPECT_EQ(rate.serve(Time{}, 100), Time{1ms});
  EXPECT_EQ(rate.serve(Time{30ms}, 100), Time{30ms + 20ms + 1ms});
  EXPECT_EQ(rate.serve(Time{60ms}, 100), Time{60ms + 40ms + 1ms});
  EXPECT_EQ(rate.serve(Time{90ms}, 100), Time{90ms + 10ms + 1ms});
  LinkRate full{{.bits_per_s = 800'000, .queue_wait = 30ms, .competing_peak = 40ms, .competing_period = 100ms}};
  EXPECT_TRUE(full.serve(Time{45ms}, 100));   // a wait of 30 ms
  EXPECT_FALSE(full.serve(Time{46ms}, 100));  // a longer wait
}

PathSpec all_models() {
  PathSpec spec;
  spec.floor = 5ms;
  spec.rate = {.bits_per_s = 2'000'000, .competing_peak = 40ms, .competing_period = 1s};
  spec.body = cases()[4].body;
  spec.regimes = {{.mean = 100ms}, {.mean = 300ms, .floor = 5ms, .body = cases()[2].body}};
  spec.boundary = {
      .period = 1s, .stall_low = 1ms, .stall_high = 40ms, .floor_high = 20ms, .loss_window = 5ms, .loss = 1};
  spec.slots = {.period = 1ms, .datagrams = 3};
  return spec;
}

TEST(DelayModels, KeepFloorAndOrderTogetherAndTakeNoHeap) {
  Path path = path_of(all_models());
  const tandem::test::AllocGuard guard;
  Time last{};
  for (std::int64_t i = 0; i < 50'000; ++i) {
    const PathDecision v = path.send(Time{i * 700us}, kSize);
    if (dropped(v.outcome)) continue;
    ASSERT_GE(v.at, Time{i * 700us} + 5ms);
    ASSERT_GE(v.at, last);
    last = v.at;
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(DelayModels, ChangeNoOtherDecision) {
  PathSpec more = all_models(), less = all_models();
  more.loss.probability = less.loss.probability = 0.1;
  less.regimes.clear();
  less.body = {};
  less.slots = {};
  const auto a = decisions(path_of(more), 20'000), b = decisions(path_of(less), 20'000);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].outcome, b[i].outcome) << i;
}

TEST(DelayModels, NameMistakes) {
  PathSpec spec;
  spec.body = {.kind = Kind::kHyperExponential, .cap = 1s, .phases = {{0.5, 1ms}, {0.4, 0ms}}};
  spec.regimes = {{.mean = 0ms, .body = {.kind = Kind::kEmpirical, .quantiles = {{0, 2ms}, {0.5, 1ms}}}}};
  spec.boundary = {.period = 1s, .phase = 1s, .stall_high = 2s, .loss = 0.5};
  spec.slots = {.datagrams = 1};
  spec.order = ArrivalOrder::kFree;
  spec.rate = {.bits_per_s = 1000, .competing_peak = 5ms, .competing_period = 5ms};
  std::string keys;
  for (const SpecError& problem : problems(spec)) keys += problem.key + " ";
  EXPECT_EQ(keys,
            "rate.competing_period body.phases[1].mean body.phases regimes regimes[0].mean regimes[0].body.quantiles "
            "regimes[0].body.quantiles[1].delay boundary.phase boundary.stall_high boundary.loss slots.period "
            "slots.period ");
}

TEST(DelayModels, AreReadFromAProfile) {
  const auto profile = parse_profile(R"(
    version: 1
    up {
      rate { rate_bit_s: 1e6 competing_peak_ms: 800 competing_period_ms: 8000 }
      body { hyper_exponential { phase { weight: 0.75 mean_ms: 30 } phase { weight: 0.25 mean_ms: 10 } cap_ms: 500 } tau_ms: 20 }
      regime { mean_ms: 100 body { gamma { shape: 2 scale_ms: 3 cap_ms: 50 } } }
      regime { mean_ms: 200 floor_ms: 4 body { truncated_normal { mean_ms: 5 sd_ms: 2 low_ms: 1 cap_ms: 9 } } }
      boundary { period_s: 15 phase_s: 2 stall_low_ms: 30 stall_high_ms: 140 floor_high_ms: 12 loss_window_ms: 100 loss_percent: 5 }
      slots { period_ms: 5 datagrams: 8 bytes: 4000 }
    }
    down { body { empirical { point { percent: 0 delay_ms: 1 } point { percent: 100 delay_ms: 3 } } } })",
                                     "p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  const PathSpec& up = profile->link.up;
  EXPECT_EQ(up.rate.competing_peak, 800ms);
  EXPECT_EQ(up.rate.competing_period, 8s);
  EXPECT_EQ(up.body.phases, (std::vector<HyperPhase>{{0.75, 30ms}, {0.25, 10ms}}));
  ASSERT_EQ(up.regimes.size(), 2U);
  EXPECT_EQ(up.regimes[0].body.kind, Kind::kGamma);
  EXPECT_EQ(up.regimes[1].floor, 4ms);
  EXPECT_EQ(up.regimes[1].body.sd, 2ms);
  EXPECT_EQ(up.boundary, (BoundarySpec{15s, 2s, 30ms, 140ms, 12ms, 100ms, 0.05}));
  EXPECT_EQ(up.slots, (SlotsSpec{5ms, 8, 4000}));
  EXPECT_EQ(profile->link.down.body.quantiles, (std::vector<QuantilePoint>{{0, 1ms}, {1, 3ms}}));
  const auto expect = [](std::string_view body, std::string_view message) {
    const auto bad = parse_profile("version: 1\nboth {\n" + std::string(body) + "\n}\n", "p.textproto");
    ASSERT_FALSE(bad) << body;
    EXPECT_NE(to_text(bad.error()).find(message), std::string::npos) << to_text(bad.error());
  };
  expect("body { pareto { least_ms: 5 alpha: 0 cap_ms: 4 } }", "p.textproto:3:36: both.body.pareto.alpha = 0");
  expect("body { pareto { least_ms: 5 alpha: 1 cap_ms: 4 } }", "p.textproto:3:46: both.body.pareto.cap_ms = 4");
  expect("body { hyper_exponential { phase { weight: 0.5 mean_ms: 1 } cap_ms: 4 } }",
         "p.textproto:3:8: both.body.hyper");
  expect("regime { mean_ms: 5 }", "p.textproto:3:1: both.regime[0]");
  expect("boundary { period_s: 1 phase_s: 1 }", "p.textproto:3:33: both.boundary.phase_s = 1");
  expect("order: FREE slots { period_ms: 5 }", "p.textproto:3:13: both.slots");
  expect("rate { rate_bit_s: 1e6 competing_peak_ms: 5 competing_period_ms: 5 }", "p.textproto:3:66");
}

}  // namespace
}  // namespace tandem::netsim
