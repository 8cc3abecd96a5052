#include "server/policy/load_shedder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// A tick thread of 1 kHz in virtual time.
struct Thread {
  /// @param receiving  processor time of the thread beside the tick
  LoadState tick(Duration late, Duration used, Duration receiving = 0ms) {
    const LoadState now_so = ladder.step(now, late, used, used + receiving);
    if (rungs.empty() || rungs.back() != now_so.level) {
      rungs.push_back(now_so.level);
      changed.push_back(now);
    }
    now += 1ms;
    return now_so;
  }
  /// Runs punctual ticks; each uses this share of its period.
  LoadState full(double share, Duration length) {
    for (const Time end = now + length; now < end;) tick(0ms, from_seconds(share * 1e-3));
    return ladder.load_state();
  }

  LoadShedder ladder{1ms};
  Time now{1h};
  std::vector<ShedLevel> rungs;  ///< in order of time
  std::vector<Time> changed;
};

TEST(LoadShedder, RaisesTheLevelEvery100MillisecondsInOrder) {
  Thread thread;
  thread.full(0.9, 2s);
  const std::vector<ShedLevel> order{
      ShedLevel::kNone,          ShedLevel::kTelemetry,          ShedLevel::kObservers20Hz,
      ShedLevel::kObservers10Hz, ShedLevel::kEvaluatorsEvery2nd, ShedLevel::kEvaluatorsEvery3rd,
      ShedLevel::kNewJoins};
  EXPECT_EQ(thread.rungs, order);
  for (std::size_t i = 1; i < thread.changed.size(); ++i)
    EXPECT_EQ(thread.changed[i] - Time{1h}, i * 100ms - 1ms) << "with the last tick of its window";
  EXPECT_FALSE(thread.ladder.load_state().overloaded) << "full is not late";
}

TEST(LoadShedder, StopsBelowTheLevelWhoseThresholdIsNotReached) {
  const std::vector<std::pair<double, ShedLevel>> table{{0.39, ShedLevel::kNone},
                                                        {0.41, ShedLevel::kTelemetry},
                                                        {0.45, ShedLevel::kObservers20Hz},
                                                        {0.49, ShedLevel::kObservers10Hz},
                                                        {0.53, ShedLevel::kEvaluatorsEvery2nd},
                                                        {0.57, ShedLevel::kEvaluatorsEvery3rd},
                                                        {0.84, ShedLevel::kEvaluatorsEvery3rd},
                                                        {0.86, ShedLevel::kNewJoins}};
  for (const auto& [share, rung] : table) {
    Thread full, late;
    EXPECT_EQ(full.full(share, 2s).level, rung) << share;
    for (int n = 0; n < 2000; ++n) late.tick(from_seconds(5e-3 * share), 0ms);
    EXPECT_EQ(late.ladder.load_state().level, std::min(rung, ShedLevel::kEvaluatorsEvery3rd))
        << "late by " << share << " of 5 ms: load of other programs removes no evaluator";
  }
}

TEST(LoadShedder, IgnoresUpToTenPercentSlowTicks) {
  for (const int stragglers : {10, 11}) {
    Thread thread;
    for (int n = 0; n < 100; ++n) thread.tick(0ms, n < stragglers ? 900us : 100us);
    EXPECT_EQ(thread.ladder.load_state().level, stragglers == 10 ? ShedLevel::kNone : ShedLevel::kTelemetry);
  }
}

TEST(LoadShedder, LowersTheLevelEveryFiveSecondsWhenLoadIsTenPercentBelow) {
  Thread thread;
  EXPECT_EQ(thread.full(0.45, 1s).level, ShedLevel::kObservers20Hz);
  EXPECT_EQ(thread.full(0.35, 1min).level, ShedLevel::kObservers20Hz) << "0.44 - 0.10 is not reached";
  EXPECT_EQ(thread.full(0.33, 4900ms).level, ShedLevel::kObservers20Hz);
  EXPECT_EQ(thread.full(0.33, 200ms).level, ShedLevel::kTelemetry);
  EXPECT_EQ(thread.full(0.33, 1min).level, ShedLevel::kTelemetry) << "0.40 - 0.10 is not reached";
  EXPECT_EQ(thread.full(0.1, 6s).level, ShedLevel::kNone);
}

/// The first level saves much load, and its end brings the load back: the worst case for hysteresis.
TEST(LoadShedder, DoublesItsRecoveryDelayAfterEachEarlyRecovery) {
  Thread thread;
  for (const Time end = thread.now + 10min; thread.now < end;)
    thread.full(thread.ladder.load_state().level == ShedLevel::kNone ? 0.42 : 0.2, 1ms);
  ASSERT_GE(thread.changed.size(), 10u);
  for (std::size_t i = 2, stay = 5; i + 1 < thread.changed.size(); i += 2, stay = std::min<std::size_t>(2 * stay, 40))
    EXPECT_EQ(thread.changed[i] - thread.changed[i - 1], std::chrono::seconds(stay)) << i;
  EXPECT_LE(thread.changed.size(), 2u * (3 + 600 / 40)) << "a log line every 20 s";
}

TEST(LoadShedder, ResetsItsRecoveryDelayAfterAMinute) {
  Thread thread;
  thread.full(0.42, 100ms);
  EXPECT_EQ(thread.full(0.1, 6s).level, ShedLevel::kNone);
  thread.full(0.1, 70s);
  thread.full(0.42, 100ms);
  EXPECT_EQ(thread.full(0.1, 4900ms).level, ShedLevel::kTelemetry);
  EXPECT_EQ(thread.full(0.1, 200ms).level, ShedLevel::kNone) << "5 s again, not 10";
}

TEST(LoadShedder, ReportsOverloadAtTheThirdConsecutiveTickOver5MillisecondsLate) {
  Thread thread;
  EXPECT_FALSE(thread.tick(6ms, 0ms).overloaded);
  EXPECT_FALSE(thread.tick(6ms, 0ms).overloaded);
  EXPECT_TRUE(thread.tick(6ms, 0ms).overloaded) << "in this very tick";
}

TEST(LoadShedder, ReportsNoOverloadBelowThreeConsecutiveLateTicks) {
  Thread thread;
  for (int n = 0; n < 1000; ++n)
    ASSERT_FALSE(thread.tick(n % 3 == 2 ? 5ms : 300ms, 0ms).overloaded) << "two in a row, the third exactly 5 ms";
  for (int n = 0; n < 1000; ++n) ASSERT_FALSE(thread.tick(5ms, 900us).overloaded);
}

TEST(LoadShedder, ClearsOverloadAfterADelayThatDoublesFromOneToFourSeconds) {
  Thread thread;
  const auto three = [&] {
    for (int n = 0; n < 3; ++n) thread.tick(6ms, 0ms);
    EXPECT_TRUE(thread.ladder.load_state().overloaded);
  };
  const auto away = [&] {  // time since the third late tick
    const Time third = thread.now - 1ms;
    while (thread.ladder.load_state().overloaded && thread.now - third < 1min) {
      thread.tick(thread.now.time_since_epoch() / 1ms % 10 == 0 ? 20ms : 0ms,
                  0ms);  // single late ticks do not extend the wait
    }
    return thread.now - 1ms - third;
  };
  for (const Duration wait : {1000ms, 2000ms, 4000ms, 4000ms}) {
    three();
    EXPECT_EQ(away(), wait) << "again within a minute: twice as long, 4 s at most";
    for (int n = 0; n < 500; ++n) thread.tick(0ms, 0ms);
  }
  for (int n = 0; n < 61'000; ++n) thread.tick(0ms, 0ms);
  three();
  EXPECT_EQ(away(), 1000ms) << "after a minute it is forgotten";
}

TEST(LoadShedder, CountsItsWindowInTicksOfAnyRate) {
  LoadShedder ladder{4ms};  // 25 ticks in 0.1 s
  Time now{1h};
  for (int n = 0; n < 24; ++n, now += 4ms) ASSERT_EQ(ladder.step(now, 0ms, 2ms, 2ms).level, ShedLevel::kNone);
  EXPECT_EQ(ladder.step(now, 0ms, 2ms, 2ms).level, ShedLevel::kTelemetry);
}

TEST(LoadShedder, TakesNoHeap) {
  Thread thread;
  thread.rungs.reserve(64);
  thread.changed.reserve(64);
  const tandem::test::AllocGuard guard;
  thread.full(0.7, 1s);
  for (int n = 0; n < 10; ++n) thread.tick(6ms, 0ms);
  thread.full(0.1, 1min);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(LoadShedder, RejectsJoinsAtItsLastLevelAtTheLimitOfAdmissionControl) {
  EXPECT_EQ(LoadShedder::threshold(ShedLevel::kNewJoins), LoadLimits{}.busy);
  EXPECT_EQ(rejection_reason({0.1, false}, 0.1, 2, {}), "");
  EXPECT_NE(rejection_reason({0.1, true}, 0.1, 2, {}).find("worked for more than 85 %"), std::string::npos);

  // 200 us of receiving beside each tick. A few long ticks are no reason.
  Thread thread;
  for (int n = 0; n < 2000; ++n) thread.tick(0ms, n % 5 == 0 ? 1000us : 500us, 200us);
  EXPECT_EQ(thread.ladder.load_state().level, ShedLevel::kEvaluatorsEvery3rd) << "works for 0.80 of the time";
  for (int n = 0; n < 100; ++n) thread.tick(0ms, 670us, 200us);
  EXPECT_EQ(thread.ladder.load_state().level, ShedLevel::kNewJoins) << "0.87 for a tenth of a second";
  for (int n = 0; n < 5200; ++n) thread.tick(0ms, 620us, 200us);
  EXPECT_EQ(thread.ladder.load_state().level, ShedLevel::kEvaluatorsEvery3rd) << "0.82 for 5 s";
}

}  // namespace
}  // namespace tandem::server
