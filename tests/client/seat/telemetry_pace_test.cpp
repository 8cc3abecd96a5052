#include "client/seat/telemetry_pace.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

int carried(TelemetryPace& pace, std::uint32_t from, std::uint32_t ticks, bool every) {
  int n = 0;
  for (std::uint32_t tick = from; tick != from + ticks; ++tick) n += pace.due(tick, every) ? 1 : 0;
  return n;
}

TEST(TelemetryPace, SendsAtMostSixtyPerSecondAtAnyTickRate) {
  for (const double hz : {100.0, 200.0, 1000.0, 2000.0, 10000.0}) {
    TelemetryPace pace(hz);
    const int n = carried(pace, 0, static_cast<std::uint32_t>(10 * hz), false);
    EXPECT_LE(n, 600) << hz;
    EXPECT_GE(n, 500) << hz;
  }
}

TEST(TelemetryPace, SendsEveryTickWhileTheServerRecords) {
  TelemetryPace pace(1000);
  EXPECT_EQ(carried(pace, 0, 1000, true), 1000);
  EXPECT_EQ(carried(pace, 1000, 16, false), 0) << "the interval counts from the last one";
}

// Heartbeats at 1 kHz come every 16 ticks, one before telemetry is due.
TEST(TelemetryPace, LetsEveryHeartbeatCarryTelemetryIfItMayBeEarly) {
  TelemetryPace pace(1000, 1), punctual(1000), slow(60, 1);
  int early = 0, late = 0;
  for (std::uint32_t tick = 0; tick < 1600; tick += 16) {
    early += pace.due(tick, false) ? 1 : 0;
    late += punctual.due(tick, false) ? 1 : 0;
  }
  EXPECT_EQ(early, 100);
  EXPECT_EQ(late, 50);
  for (std::uint32_t tick = 0; tick < 10; ++tick) EXPECT_TRUE(slow.due(tick, false));
}

TEST(TelemetryPace, BeginsWithTelemetryOnEachConnection) {
  TelemetryPace pace(1000);
  EXPECT_TRUE(pace.due(5, false));
  EXPECT_FALSE(pace.due(6, false));
  pace.restart();
  EXPECT_TRUE(pace.due(7, false));
}

TEST(TelemetryPace, SurvivesSkippedTicksAndTheWrapOfTheirNumber) {
  TelemetryPace pace(1000);
  EXPECT_TRUE(pace.due(0xfffffff0U, false));
  EXPECT_FALSE(pace.due(0xffffffffU, false));
  EXPECT_TRUE(pace.due(5, false)) << "21 ticks later";
}

}  // namespace
}  // namespace tandem::client
