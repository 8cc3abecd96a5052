// Velocities of tools from the positions of two telemetries.
#include "server/console/tool_velocities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tandem::console {
namespace {

wire::SessionTelemetry at(std::uint32_t tick, double x) {
  wire::SessionTelemetry t;
  t.session_tick = tick;
  for (auto& tool : t.tools) tool.x = {x, 0, -x};
  return t;
}

TEST(ToolVelocities, AreTheDifferenceOfPositionsByTheSessionsClock) {
  ToolVelocities velocities;
  EXPECT_TRUE(std::isnan(velocities.update(at(100, 0.5), 1000)[0][0])) << "one position has no velocity";
  const auto& v = velocities.update(at(120, 0.51), 1000);  // 0.01 m in 20 ms
  EXPECT_NEAR(v[0][0], 0.5, 1e-12);
  EXPECT_EQ(v[0][1], 0);
  EXPECT_NEAR(v[kToolsMax - 1][2], -0.5, 1e-12);
  EXPECT_NEAR(velocities.update(at(130, 0.51), 500)[0][0], 0, 1e-12);
}

TEST(ToolVelocities, KeepTheLastOneOverAFewTicks) {
  ToolVelocities velocities;
  static_cast<void>(velocities.update(at(100, 0), 1000));
  EXPECT_NEAR(velocities.update(at(110, 0.01), 1000)[0][0], 1, 1e-12);
  EXPECT_NEAR(velocities.update(at(111, 0.05), 1000)[0][0], 1, 1e-12) << "a single tick is mostly noise";
  EXPECT_NEAR(velocities.update(at(120, 0.03), 1000)[0][0], 2, 1e-12) << "since tick 110";
}

TEST(ToolVelocities, AreUnknownAfterAGapAndWhileTheClockStandsStill) {
  ToolVelocities velocities;
  static_cast<void>(velocities.update(at(100, 0), 1000));
  EXPECT_FALSE(std::isnan(velocities.update(at(110, 0.01), 1000)[0][0]));
  EXPECT_TRUE(std::isnan(velocities.update(at(110, 0.01), 1000)[0][0])) << "a stopped session";
  EXPECT_TRUE(std::isnan(velocities.update(at(400, 0.01), 1000)[0][0])) << "0.29 s";
  EXPECT_FALSE(std::isnan(velocities.update(at(420, 0.01), 1000)[0][0]));
  EXPECT_TRUE(std::isnan(velocities.update(at(10, 0.01), 1000)[0][0])) << "another run of the session";
  EXPECT_TRUE(std::isnan(velocities.update(at(30, std::numeric_limits<double>::quiet_NaN()), 1000)[0][0]));
}

}  // namespace
}  // namespace tandem::console
