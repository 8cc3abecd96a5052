#include "client/seat/device_port.h"

#include <gtest/gtest.h>

#include <limits>

namespace tandem::client {
namespace {

hal::State reading_at(double x) {
  hal::State s;
  s.J.leftCols<3>().setIdentity();
  s.q[0] = s.x[0] = x;
  return s;
}

DevicePort tip_port() { return {PortSpace::kTip, 3, 3}; }

TEST(DevicePort, ReplacesAnInvalidReadingByTheLastValidOneForThreeTicks) {
  hal::State stale = reading_at(5), nan = reading_at(std::numeric_limits<double>::quiet_NaN()), far = reading_at(11);
  stale.stale = true;
  for (const hal::State& invalid : {stale, nan, far}) {
    DevicePort port = tip_port();
    EXPECT_TRUE(port.update(reading_at(0.01)));
    for (int k = 1; k <= 4; ++k) {
      EXPECT_EQ(port.update(invalid), k <= 3) << k;
      EXPECT_EQ(port.q()[0], 0.01);
    }
    EXPECT_TRUE(port.update(reading_at(0.02)));
    EXPECT_EQ(port.q()[0], 0.02);
  }
}

TEST(DevicePort, CountsTheEnergyThatTheMotorsDelivered) {
  DevicePort port = tip_port();
  ASSERT_TRUE(port.update(reading_at(0)));
  hal::State moved = reading_at(0.01);
  moved.tau_out[0] = 2;  // [N] held over 10 mm
  ASSERT_TRUE(port.update(moved));
  wire::Telemetry t;
  port.fill({1.5}, t);
  EXPECT_DOUBLE_EQ(t.delivered_j, 0.02);
  EXPECT_DOUBLE_EQ(t.f_cmd[0], 1.5);
  EXPECT_DOUBLE_EQ(t.x[0], 0.01);
  EXPECT_DOUBLE_EQ(t.q[0], 0.01);
}

TEST(DevicePort, MapsEffortsByTheJacobianOfTheReading) {
  DevicePort port = tip_port();
  hal::State s = reading_at(0);
  s.J(0, 0) = 0.2;  // a lever of 0.2 m
  ASSERT_TRUE(port.update(s));
  EXPECT_DOUBLE_EQ(port.joint_effort({3})[0], 0.6);
  EXPECT_DOUBLE_EQ(port.tip_force({3})[0], 3);
}

}  // namespace
}  // namespace tandem::client
