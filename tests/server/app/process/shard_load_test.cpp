// Load of a tick thread, tick by tick.
#include "server/app/process/shard_load.h"

#include <gtest/gtest.h>

#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart = Time{} + 1h;

/// Ticks of 1 ms. Each takes `spent` of the processor and begins `late`.
struct Thread {
  std::uint32_t tick(Duration spent, Duration late = 0ns, bool serving = true) {
    const std::uint32_t missed = load.begin_tick(now, late, serving);
    load.end_tick(now, used, used + spent);
    used += spent;
    now += 1ms;
    return missed;
  }
  ShardLoad load{1ms};
  Time now = kStart;
  Duration used{};
};

TEST(ShardLoad, CountsLateTicksOnlyWhileItServesASession) {
  Thread thread;
  EXPECT_EQ(thread.tick(10us, 1ms), 1U);
  EXPECT_EQ(thread.tick(10us, 3500us), 3U);
  EXPECT_EQ(thread.tick(10us, 5ms, false), 5U);
  EXPECT_EQ(thread.tick(10us, -10us), 0U) << "woken early";
  EXPECT_EQ(thread.load.late_ticks(), 1U) << "a tick 1 ms late is in time";
  EXPECT_EQ(thread.load.machine().late_ticks, 1U);
  EXPECT_EQ(thread.load.machine().missed_ticks, 4U);
  EXPECT_EQ(thread.load.last_tick(), kStart + 3ms);
  std::uint64_t ticks = 0;
  for (std::size_t i = 0; i <= TickHistogram::kBounds.size(); ++i) ticks += thread.load.lateness().count(i);
  EXPECT_EQ(ticks, 4U);
}

TEST(ShardLoad, ReportsThe99thPercentileOfAThousandTicks) {
  Thread thread;
  for (int i = 0; i < 999; ++i) thread.tick(i % 50 == 0 ? 600us : 100us);
  EXPECT_EQ(thread.load.tick_share(), 0) << "not yet known";
  thread.tick(100us);
  EXPECT_NEAR(thread.load.tick_share(), 0.6, 0.05) << "2 % of the ticks take 600 us";
}

TEST(ShardLoad, ReportsTheShareOfAProcessorOncePerSecond) {
  Thread thread;
  for (int i = 0; i < 1000; ++i) thread.tick(250us);
  EXPECT_EQ(thread.load.cpu_share(), 0);
  thread.tick(250us);
  EXPECT_NEAR(thread.load.cpu_share(), 0.25, 1e-9);
}

TEST(ShardLoad, ToleratesFourTimesTheLatenessWithoutRealTimePriority) {
  Thread granted, refused;
  granted.load.set_realtime(true);
  for (int i = 0; i < 20; ++i) {
    granted.tick(10us, 8ms);
    refused.tick(10us, 8ms);
  }
  EXPECT_TRUE(granted.load.state().overloaded);
  EXPECT_FALSE(refused.load.state().overloaded);
  for (int i = 0; i < 20; ++i) refused.tick(10us, 32ms);
  EXPECT_TRUE(refused.load.state().overloaded);
  EXPECT_TRUE(refused.load.machine().load_state.overloaded) << "the sessions know it";
}

TEST(ShardLoad, CountsAnOverloadOnceWhileItServesASession) {
  Thread thread;
  const auto overload = [&](bool serving) {
    for (int i = 0; i < 5; ++i) thread.tick(10us, 30ms, serving);
    EXPECT_TRUE(thread.load.state().overloaded);
    for (int i = 0; i < 10'000 && thread.load.state().overloaded; ++i) thread.tick(10us, 0ns, serving);
    EXPECT_FALSE(thread.load.state().overloaded);
  };
  overload(true);
  EXPECT_EQ(thread.load.overloads(), 1U);
  overload(false);
  EXPECT_EQ(thread.load.overloads(), 1U) << "no hand was released";
  overload(true);
  EXPECT_EQ(thread.load.overloads(), 2U);
}

TEST(ShardLoad, TakesNoHeap) {
  Thread thread;
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 3000; ++i) thread.tick(300us, i % 7 == 0 ? 2ms : 0ms);
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::server
