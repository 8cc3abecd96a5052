#include "netsim/models/endpoint_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

TEST(EndpointClock, OffsetDriftAndStepsAddUp) {
  // 100 ppm for 10 s are exactly 1 ms.
  const EndpointClock clock{{.offset = 5ms, .drift_ppm = 100, .steps = {{2s, 30ms}, {4s, -10ms}}}};
  EXPECT_EQ(clock.at(Time{}), Time{5ms});
  EXPECT_EQ(clock.at(Time{1s}), Time{1s + 5ms + 100us});
  EXPECT_EQ(clock.at(Time{2s - 1ns}), Time{2s - 1ns + 5ms + 199'999ns});  // 199 999.9999 rounded down
  EXPECT_EQ(clock.at(Time{2s}), Time{2s + 5ms + 200us + 30ms});
  EXPECT_EQ(clock.at(Time{10s}), Time{10s + 5ms + 1ms + 20ms});
}

TEST(EndpointClock, SlowClocksRoundDownTooAndNeverGoBack) {
  const EndpointClock clock{{.drift_ppm = -1000}};
  EXPECT_EQ(clock.at(Time{1ns}), Time{});  // 1 - 0.001 ns
  EXPECT_EQ(clock.at(Time{1s}), Time{999ms});
  for (const double ppm : {-1000.0, -0.37, 0.0, 12.5, 1000.0}) {
    const EndpointClock any{{.drift_ppm = ppm}};
    Time last = any.at(Time{});
    RandomStream random{4};
    Time now{};
    for (int i = 0; i < 20'000; ++i) {
      now += Duration{static_cast<std::int64_t>(random.below(3000))};
      const Time own = any.at(now);
      ASSERT_GE(own, last);
      last = own;
    }
  }
}

TEST(EndpointClock, IsExactAfterYears) {
  // 3650 days at 1000 ppm are 3.65 days; no floating sum would keep the nanosecond.
  const EndpointClock clock{{.drift_ppm = 1000}};
  const Duration years = std::chrono::hours(24) * 3650;
  EXPECT_EQ(clock.at(Time{years + 1us}), Time{years + 1us + years / 1000 + 1ns});
}

TEST(EndpointClock, RejectsImpossibleValuesWithTheirKey) {
  const auto keys = [](const EndpointSpec& spec) {
    std::string all;
    for (const SpecError& problem : problems(spec)) all += problem.key + " ";
    return all;
  };
  EXPECT_EQ(keys({}), "");
  EXPECT_EQ(keys({.offset = 25h, .drift_ppm = 1001}), "offset drift_ppm ");
  EXPECT_EQ(keys({.drift_ppm = std::nan("")}), "drift_ppm ");
  EXPECT_EQ(keys({.steps = {{2s, 1s}, {2s, 25h}}}), "steps[1].by steps[1].at ");
  EXPECT_EQ(keys({.wake = {.late_max = 1ms}}), "wake.late_max ");
  EXPECT_EQ(keys({.wake = {.kind = WakeSpec::Kind::kUniform, .late_max = 2s}}), "wake.late_max ");
  EXPECT_EQ(keys({.wake = {.kind = WakeSpec::Kind::kUniform, .phase = -1ns}}), "wake.phase ");
  EXPECT_EQ(keys({.wake = {.phase = 1us, .shifts = true}}), "wake.phase wake.shifts ");
  EXPECT_THROW(EndpointClock({.drift_ppm = 2000}), std::invalid_argument);
  EXPECT_THROW(WakeUps({}, Duration::zero(), Time{}, RandomKey{1}), std::invalid_argument);
}

TEST(WakeUps, EqualTheTicksWhenExact) {
  WakeUps wakes{{}, 1ms, Time{5ms}, RandomKey{1}};
  EXPECT_FALSE(wakes.due(Time{5ms - 1ns}));
  for (int i = 5; i < 100; ++i) {
    EXPECT_TRUE(wakes.due(Time{i * 1ms}));
    EXPECT_FALSE(wakes.due(Time{i * 1ms + 999us}));
  }
  EXPECT_EQ(wakes.count(), 95U);
  EXPECT_EQ(wakes.skipped(), 0U);
}

TEST(WakeUps, SkipTheTicksMissedInAStall) {
  WakeUps wakes{{}, 1ms, Time{}, RandomKey{1}};
  EXPECT_TRUE(wakes.due(Time{}));
  EXPECT_TRUE(wakes.due(Time{4ms + 500us}));  // serves tick 1; ticks 2, 3 and 4 are skipped
  EXPECT_EQ(wakes.skipped(), 3U);
  EXPECT_EQ(wakes.next(), Time{5ms});
}

TEST(WakeUps, GiveTheExactNanosecondWithinATick) {
  const RandomKey key{9};
  const WakeSpec spec{.kind = WakeSpec::Kind::kUniform, .late_max = 900us};
  WakeUps wakes{spec, 1ms, Time{}, key};
  for (std::int64_t n = 0; n < 10'000; ++n) {
    const Time meant =
        Time{n * 1ms} + Duration{static_cast<std::int64_t>(key.uniform(static_cast<std::uint64_t>(n)) * 900'001)};
    const auto woke = wakes.within(Time{n * 1ms}, Time{(n + 1) * 1ms});
    ASSERT_TRUE(woke) << n;
    ASSERT_EQ(*woke, meant) << n;
  }
  EXPECT_EQ(wakes.skipped(), 0U);
  // After a pause of the caller, the overdue wake-up occurs at once, and those in between are skipped.
  EXPECT_EQ(wakes.within(Time{10'003ms}, Time{10'004ms}), Time{10'003ms});
  EXPECT_EQ(wakes.skipped(), 3U);
  EXPECT_FALSE(wakes.within(Time{10'003ms}, Time{10'004ms - 1ns}));
}

TEST(WakeUps, KeepTheirPhaseUntilTheyAreShifted) {
  WakeUps wakes{{.kind = WakeSpec::Kind::kUniform, .phase = 300us}, 1ms, Time{}, RandomKey{9}};
  EXPECT_EQ(wakes.within(Time{}, Time{1ms}), Time{300us});
  EXPECT_EQ(wakes.within(Time{1ms}, Time{2ms}), Time{1300us});
  wakes.shift(10us);
  EXPECT_EQ(wakes.within(Time{2ms}, Time{3ms}), Time{2310us});
  wakes.shift(-320us);
  EXPECT_EQ(wakes.within(Time{2310us}, Time{3ms}), Time{2990us}) << "twice within one tick of the caller";
  EXPECT_EQ(wakes.within(Time{3ms}, Time{4ms}), Time{3990us});
  EXPECT_EQ(wakes.skipped(), 0U);
}

TEST(WakeUps, AreLateByAKeyedShareAndNeverEarly) {
  const RandomKey key{9};
  WakeUps wakes{{.kind = WakeSpec::Kind::kUniform, .late_max = 400us}, 1ms, Time{}, key};
  double sum = 0;
  constexpr int n = 10'000;
  for (int i = 0; i < n; ++i) {
    const Duration late = wakes.next() - Time{i * 1ms};
    ASSERT_GE(late, Duration::zero());
    ASSERT_LE(late, 400us);
    ASSERT_EQ(late.count(), static_cast<std::int64_t>(key.uniform(static_cast<std::uint64_t>(i)) * 400'001));
    sum += static_cast<double>(late.count());
    ASSERT_FALSE(wakes.due(wakes.next() - 1ns));
    ASSERT_TRUE(wakes.due(wakes.next()));
  }
  // Mean 200 us, standard error 400 / sqrt(12 n) = 1.15 us.
  EXPECT_NEAR(sum / n, 200'000, 6'000);
  EXPECT_EQ(wakes.skipped(), 0U);
}

TEST(WakeUps, FollowTheMeasuredDistribution) {
  EXPECT_DOUBLE_EQ(WakeUps::measured_step(0), 1);
  EXPECT_DOUBLE_EQ(WakeUps::measured_step(0.25), 1.01);
  EXPECT_DOUBLE_EQ(WakeUps::measured_step(0.5), 1.02);
  EXPECT_DOUBLE_EQ(WakeUps::measured_step(0.745), 1.47);  // half way from 1.02 to 1.92
  EXPECT_DOUBLE_EQ(WakeUps::measured_step(0.99), 1.92);
  EXPECT_NEAR(WakeUps::measured_step(0.995), 2.345, 1e-12);
  EXPECT_LT(WakeUps::measured_step(0.9999999999999999), 2.77);

  WakeUps wakes{{.kind = WakeSpec::Kind::kMeasured}, 1ms, Time{}, RandomKey{3}};
  std::vector<double> steps;
  Time last = wakes.next();
  for (int i = 0; i < 100'000; ++i) {
    ASSERT_TRUE(wakes.due(wakes.next()));
    steps.push_back(static_cast<double>((wakes.next() - last).count()) / 1e6);
    last = wakes.next();
  }
  EXPECT_NEAR(quantile(steps, 0.5), 1.02, 0.01);
  EXPECT_NEAR(quantile(steps, 0.99), 1.92, 0.03);
  EXPECT_LE(quantile(steps, 1), 2.77);
  EXPECT_GT(quantile(steps, 1), 2.6);
  EXPECT_GE(quantile(steps, 0), 1);
}

TEST(WakeUps, RoundMeasuredStepsToTicksAndKeepTheMean) {
  WakeUps wakes{{.kind = WakeSpec::Kind::kMeasured}, 1ms, Time{}, RandomKey{3}};
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) static_cast<void>(wakes.due(Time{i * 1ms}));
  // Mean step: 0.5 * 1.01 + 0.49 * 1.47 + 0.01 * 2.345 = 1.24875 ticks.
  EXPECT_NEAR(static_cast<double>(n) / static_cast<double>(wakes.count()), 1.24875, 0.005);
}

TEST(WakeUps, DependOnTheKeyAlone) {
  const auto moments = [](std::uint64_t seed) {
    WakeUps wakes{{.kind = WakeSpec::Kind::kUniform, .late_max = 300us}, 1ms, Time{}, RandomKey{seed}};
    std::vector<Time> all;
    for (int i = 0; i < 1000; ++i) {
      all.push_back(wakes.next());
      static_cast<void>(wakes.due(wakes.next()));
    }
    return all;
  };
  EXPECT_EQ(moments(1), moments(1));
  EXPECT_NE(moments(1), moments(2));
}

}  // namespace
}  // namespace tandem::netsim
