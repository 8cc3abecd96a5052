#include "server/load_ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// A thread of 1 kHz in virtual time.
struct Thread {
  Relief tick(Duration late, Duration used) {
    const Relief now_so = ladder.step(now, late, used);
    if (rungs.empty() || rungs.back() != now_so.rung) {
      rungs.push_back(now_so.rung);
      changed.push_back(now);
    }
    now += 1ms;
    return now_so;
  }
  /// Ticks in time of which each takes this share of its time.
  Relief full(double share, Duration length) {
    for (const Time end = now + length; now < end;) tick(0ms, from_seconds(share * 1e-3));
    return ladder.relief();
  }

  LoadLadder ladder{1ms};
  Time now{1h};
  std::vector<Rung> rungs;   ///< in order
  std::vector<Time> changed;
};

TEST(LoadLadder, ClimbsOneRungEveryTenthOfASecondInTheDesignsOrder) {
  Thread thread;
  thread.full(0.7, 2s);
  const std::vector<Rung> order{Rung::kNothing, Rung::kTelemetry, Rung::kObservers, Rung::kObserversMore, Rung::kEvaluators, Rung::kEvaluatorsMore, Rung::kNewcomers};
  EXPECT_EQ(thread.rungs, order);
  for (std::size_t i = 1; i < thread.changed.size(); ++i) EXPECT_EQ(thread.changed[i] - Time{1h}, i * 100ms - 1ms) << "with the last tick of its window";
  EXPECT_FALSE(thread.ladder.relief().passive) << "full is not late";
}

TEST(LoadLadder, StopsAtTheRungWhoseThresholdIsNotReached) {
  const std::vector<std::pair<double, Rung>> table{{0.39, Rung::kNothing},    {0.41, Rung::kTelemetry},      {0.45, Rung::kObservers}, {0.49, Rung::kObserversMore},
                                                   {0.53, Rung::kEvaluators}, {0.57, Rung::kEvaluatorsMore}, {0.61, Rung::kNewcomers}};
  for (const auto& [share, rung] : table) {
    Thread full, late;
    EXPECT_EQ(full.full(share, 2s).rung, rung) << share;
    for (int n = 0; n < 2000; ++n) late.tick(from_seconds(5e-3 * share), 0ms);
    EXPECT_EQ(late.ladder.relief().rung, std::min(rung, Rung::kEvaluatorsMore)) << "late by " << share << " of 5 ms: others' work sends nobody away";
  }
}

TEST(LoadLadder, LeavesStragglersAlone) {
  for (const int stragglers : {10, 11}) {
    Thread thread;
    for (int n = 0; n < 100; ++n) thread.tick(0ms, n < stragglers ? 900us : 100us);
    EXPECT_EQ(thread.ladder.relief().rung, stragglers == 10 ? Rung::kNothing : Rung::kTelemetry);
  }
}

TEST(LoadLadder, ComesDownOneRungEveryFiveSecondsOnceTheStrainIsTenPercentBelow) {
  Thread thread;
  EXPECT_EQ(thread.full(0.45, 1s).rung, Rung::kObservers);
  EXPECT_EQ(thread.full(0.35, 1min).rung, Rung::kObservers) << "0.44 - 0.10 is not reached";
  EXPECT_EQ(thread.full(0.33, 4900ms).rung, Rung::kObservers);
  EXPECT_EQ(thread.full(0.33, 200ms).rung, Rung::kTelemetry);
  EXPECT_EQ(thread.full(0.33, 1min).rung, Rung::kTelemetry) << "0.40 - 0.10 is not reached";
  EXPECT_EQ(thread.full(0.1, 6s).rung, Rung::kNothing);
}

/// What the first rung saves brings the strain far down, what it gives back brings it up again: the worst case for a ladder.
TEST(LoadLadder, WaitsLongerEachTimeItCameDownTooEarly) {
  Thread thread;
  for (const Time end = thread.now + 10min; thread.now < end;) thread.full(thread.ladder.relief().rung == Rung::kNothing ? 0.42 : 0.2, 1ms);
  ASSERT_GE(thread.changed.size(), 10u);
  for (std::size_t i = 2, stay = 5; i + 1 < thread.changed.size(); i += 2, stay = std::min<std::size_t>(2 * stay, 40))
    EXPECT_EQ(thread.changed[i] - thread.changed[i - 1], std::chrono::seconds(stay)) << i;
  EXPECT_LE(thread.changed.size(), 2u * (3 + 600 / 40)) << "a log line every 20 s";
}

TEST(LoadLadder, ForgetsAfterAMinuteThatItCameDownTooEarly) {
  Thread thread;
  thread.full(0.42, 100ms);
  EXPECT_EQ(thread.full(0.1, 6s).rung, Rung::kNothing);
  thread.full(0.1, 70s);
  thread.full(0.42, 100ms);
  EXPECT_EQ(thread.full(0.1, 4900ms).rung, Rung::kTelemetry);
  EXPECT_EQ(thread.full(0.1, 200ms).rung, Rung::kNothing) << "5 s again, not 10";
}

TEST(LoadLadder, MakesHandsPassiveAtTheThirdTickInARowMoreThanFiveMillisecondsLate) {
  Thread thread;
  EXPECT_FALSE(thread.tick(6ms, 0ms).passive);
  EXPECT_FALSE(thread.tick(6ms, 0ms).passive);
  EXPECT_TRUE(thread.tick(6ms, 0ms).passive) << "in this very tick";
}

TEST(LoadLadder, LeavesHandsAloneForAnythingLess) {
  Thread thread;
  for (int n = 0; n < 1000; ++n) ASSERT_FALSE(thread.tick(n % 3 == 2 ? 5ms : 300ms, 0ms).passive) << "two in a row, the third exactly 5 ms";
  for (int n = 0; n < 1000; ++n) ASSERT_FALSE(thread.tick(5ms, 900us).passive);
}

TEST(LoadLadder, GivesHandsBackASecondAfterTheLastThreeInARow) {
  Thread thread;
  const auto three = [&] {
    for (int n = 0; n < 3; ++n) thread.tick(6ms, 0ms);
    EXPECT_TRUE(thread.ladder.relief().passive);
  };
  const auto away = [&] {  // how long since the third
    const Time third = thread.now - 1ms;
    while (thread.ladder.relief().passive && thread.now - third < 1min) {
      thread.tick(thread.now.time_since_epoch() / 1ms % 10 == 0 ? 20ms : 0ms, 0ms);  // lone late ticks are no reason to wait
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

TEST(LoadLadder, CountsItsWindowInTicksOfAnyRate) {
  LoadLadder ladder{4ms};  // 25 ticks in 0.1 s
  Time now{1h};
  for (int n = 0; n < 24; ++n, now += 4ms) ASSERT_EQ(ladder.step(now, 0ms, 2ms).rung, Rung::kNothing);
  EXPECT_EQ(ladder.step(now, 0ms, 2ms).rung, Rung::kTelemetry);
}

TEST(LoadLadder, TakesNoHeap) {
  Thread thread;
  thread.rungs.reserve(64);
  thread.changed.reserve(64);
  const tandem::test::AllocGuard guard;
  thread.full(0.7, 1s);
  for (int n = 0; n < 10; ++n) thread.tick(6ms, 0ms);
  thread.full(0.1, 1min);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(LoadLadder, RefusesNewcomersOnItsLastRungWithTheLimitsOfAdmission) {
  EXPECT_NEAR(LoadLadder::threshold(Rung::kNewcomers), LoadLimits{}.tick, 1e-12);
  EXPECT_EQ(no_room({0.1, 0.1, false}, 0.1, 2, {}), "");
  EXPECT_NE(no_room({0.1, 0.1, true}, 0.1, 2, {}).find("goes without all that it can"), std::string::npos);
}

}  // namespace
}  // namespace tandem::server
