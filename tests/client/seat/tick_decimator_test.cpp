#include "client/seat/tick_decimator.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

/// Returns the number of ticks among exchanges 1 ms apart, each up to 0.3 ms late.
int ticks_in(Duration tick, Duration exchange, int milliseconds) {
  TickDecimator pace(tick, exchange);
  int ticks = 0;
  for (int ms = 0; ms < milliseconds; ++ms) ticks += pace.due(Time{1h + ms * 1ms + (ms * 7 % 4) * 100us}) ? 1 : 0;
  return ticks;
}

TEST(TickDecimator, TakesEveryExchangeOfADeviceWithoutARate) { EXPECT_EQ(ticks_in(10ms, 0ms, 1000), 1000); }

TEST(TickDecimator, TakesOneExchangePerTickOfTheScene) {
  EXPECT_EQ(ticks_in(10ms, 1ms, 1000), 100);
  EXPECT_EQ(ticks_in(5ms, 1ms, 1000), 200);
  EXPECT_EQ(ticks_in(2ms, 1ms, 1000), 500);
  EXPECT_EQ(ticks_in(1ms, 1ms, 1000), 1000);
  EXPECT_NEAR(ticks_in(Duration{3'333'333}, 1ms, 1000), 300, 1);
}

TEST(TickDecimator, TellsWhetherItTakesEveryExchange) {
  EXPECT_TRUE(TickDecimator(1ms, 0ms).takes_all());
  EXPECT_TRUE(TickDecimator(1ms, 1ms).takes_all());
  EXPECT_FALSE(TickDecimator(1ms, 500us).takes_all());
}

TEST(TickDecimator, TakesEveryExchangeOfADeviceAsFastAsTheScene) {
  TickDecimator pace(1ms, 1ms);
  Time now{1h};
  for (int n = 0; n < 1000; ++n) {
    now += n % 10 == 0 ? 5ms : n % 3 == 0 ? 300us : 1ms;  // a bus that stalls and catches up
    EXPECT_TRUE(pace.due(now)) << n;
  }
}

TEST(TickDecimator, DoesNotCatchUpMissedTicks) {
  TickDecimator pace(10ms, 1ms);
  EXPECT_TRUE(pace.due(Time{1h}));
  EXPECT_TRUE(pace.due(Time{1h + 95ms}));
  for (Duration t = 96ms; t < 104ms; t += 1ms) EXPECT_FALSE(pace.due(Time{1h + t}));
  EXPECT_TRUE(pace.due(Time{1h + 105ms}));
}

}  // namespace
}  // namespace tandem::client
