#include "client/diagnostics/transit_time.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

/// Adds one datagram per millisecond from `from` on, for `length`, each `transit` on its way.
void run(TransitTime& t, Duration from, Duration length, Duration transit) {
  for (Duration sent = from; sent < from + length; sent += 1ms) t.add(Time{1h} + sent + transit, sent);
}

TEST(TransitTime, MeasuresDelayRelativeToTheFastestDatagram) {
  TransitTime t;
  run(t, 0ms, 90ms, 5ms);
  EXPECT_EQ(t.jitter(), 0) << "the unknown constant, here 1 h and 5 ms, does not count";
  run(t, 90ms, 10ms, 8ms);
  EXPECT_NEAR(t.jitter(), 0.003, 0.0002);
}

TEST(TransitTime, FindsTheLargestLastingStep) {
  TransitTime t;
  run(t, 0s, 900ms, 5ms);
  EXPECT_EQ(t.largest_step(), std::nullopt);
  run(t, 900ms, 1100ms, 5ms);
  run(t, 2s, 2s, 25ms);  // another route
  run(t, 4s, 3s, 15ms);
  EXPECT_NEAR(t.largest_step().value(), 0.02, 1e-9);
}

TEST(TransitTime, TakesOneSlowDatagramForNoStep) {
  TransitTime t;
  run(t, 0s, 2s, 5ms);
  t.add(Time{1h} + 2s + 400ms, 2s);
  run(t, 2400ms, 3s, 5ms);
  EXPECT_DOUBLE_EQ(t.largest_step().value(), 0);
}

}  // namespace
}  // namespace tandem::client
