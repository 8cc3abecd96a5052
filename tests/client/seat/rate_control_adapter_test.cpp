#include "client/seat/rate_control_adapter.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/alloc_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

hal::State moving(Time at, const hal::Vec3& v) {
  hal::State state;
  state.sampled_at = at;
  state.dx = v;
  return state;
}

TEST(RateControlAdapter, IntegratesTheCommandedVelocity) {
  RateControlAdapter hand{{}};
  hal::State seen;
  for (int i = 0; i <= 500; ++i) seen = hand.integrate(moving(Time{i * 1ms}, {0.1, 0, -0.02}));
  EXPECT_NEAR(seen.x[0], 0.05, 1e-12);
  EXPECT_NEAR(seen.x[2], -0.01, 1e-12);
  EXPECT_NEAR(seen.q[0], 0.05, 1e-12);
  EXPECT_NEAR(seen.dx[0], 0.1, 1e-9);
  EXPECT_EQ(seen.J(0, 0), 1.0);
  EXPECT_EQ(seen.J(0, 1), 0.0);
}

TEST(RateControlAdapter, StopsAtTheWorkspaceLimitAndIsAtRestThere) {
  hal::DeviceCaps caps;
  caps.workspace_min = {-0.03, -0.03, -0.03};
  caps.workspace_max = {0.03, 0.04, 0.03};
  RateControlAdapter hand{caps};
  hal::State seen;
  for (int i = 0; i <= 2000; ++i) seen = hand.integrate(moving(Time{i * 1ms}, {0.1, 0.1, 0}));
  EXPECT_EQ(seen.x[0], 0.03);
  EXPECT_EQ(seen.x[1], 0.04);
  EXPECT_EQ(seen.dx[0], 0.0);
}

TEST(RateControlAdapter, BoundsTheStepAfterAPauseAndTreatsNanAsRest) {
  RateControlAdapter hand{{}};
  static_cast<void>(hand.integrate(moving(Time{0ms}, {0.1, 0, 0})));
  hal::State seen = hand.integrate(moving(Time{900ms}, {0.1, 0, 0}));
  EXPECT_NEAR(seen.x[0], 0.0005, 1e-12);
  seen = hand.integrate(moving(Time{901ms}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_NEAR(seen.x[0], 0.0005, 1e-12);
  EXPECT_TRUE(seen.dx.allFinite());
}

TEST(RateControlAdapter, ReportsAPoseDeviceToTheSeat) {
  hal::DeviceCaps device;
  device.input = hal::InputKind::kRate;
  const hal::DeviceCaps caps = RateControlAdapter::adapted_caps(device);
  EXPECT_EQ(caps.joints, 3U);
  EXPECT_EQ(caps.tip_axes, 3U);
  EXPECT_TRUE(caps.prismatic);
  EXPECT_EQ(caps.input, hal::InputKind::kPose);
  RateControlAdapter hand{device};
  hal::State quiet = moving(Time{1ms}, {0, 0, 0});
  quiet.stale = true;  // the device's velocity has decayed to zero
  EXPECT_FALSE(hand.integrate(quiet).stale);
}

TEST(RateControlAdapter, WorksWithoutHeap) {
  RateControlAdapter hand{{}};
  const test::AllocGuard guard;
  for (int i = 0; i < 1000; ++i) static_cast<void>(hand.integrate(moving(Time{i * 1ms}, {0.1, 0, 0})));
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::client
