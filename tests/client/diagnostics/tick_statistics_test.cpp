#include "client/diagnostics/tick_statistics.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

TEST(TickStatistics, CountLateAndMissedTicks) {
  TickStatistics s;
  s.add(1ms, 0, 0s);
  s.add(1001us, 3, 0s);
  s.add(5ms, 1, 0s);
  EXPECT_EQ(s.ticks(), 3U);
  EXPECT_EQ(s.late_ticks(), 2U);
  EXPECT_EQ(s.missed_ticks(), 4U);
  EXPECT_EQ(Duration{s.lateness().max()}, 5ms);
}

TEST(TickStatistics, ReportTheLargestStepOfTheWallClock) {
  TickStatistics s;
  s.add(0ms, 0, 100s);
  EXPECT_EQ(s.clock_step(), std::nullopt);
  s.add(0ms, 0, 100s + 2ms);
  s.add(0ms, 0, 100s - 3ms);
  s.add(0ms, 0, 100s);
  EXPECT_DOUBLE_EQ(s.clock_step().value(), -0.005);
}

}  // namespace
}  // namespace tandem::client
