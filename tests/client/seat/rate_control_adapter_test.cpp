#include "client/seat/rate_control_adapter.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/alloc_guard.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

struct Seen final : hal::ServoClient {
  hal::State last;
  std::vector<hal::Errc> losses;
  hal::Command tick(const hal::State& state) noexcept override {
    last = state;
    return {1, state.sampled_at + 5ms, hal::CommandKind::kJointEffort, {1, 1, 1}};
  }
  void lost(hal::Errc why) noexcept override { losses.push_back(why); }
};

hal::State moving(Time at, const hal::Vec3& v) {
  hal::State state;
  state.sampled_at = at;
  state.dx = v;
  return state;
}

TEST(RateControlAdapter, IntegratesTheCommandedVelocity) {
  Seen seat;
  RateControlAdapter hand{seat, {}};
  for (int i = 0; i <= 500; ++i) hand.tick(moving(Time{i * 1ms}, {0.1, 0, -0.02}));
  EXPECT_NEAR(seat.last.x[0], 0.05, 1e-12);
  EXPECT_NEAR(seat.last.x[2], -0.01, 1e-12);
  EXPECT_NEAR(seat.last.q[0], 0.05, 1e-12);
  EXPECT_NEAR(seat.last.dx[0], 0.1, 1e-9);
  EXPECT_EQ(seat.last.J(0, 0), 1.0);
  EXPECT_EQ(seat.last.J(0, 1), 0.0);
}

TEST(RateControlAdapter, StopsAtTheWorkspaceLimitAndIsAtRestThere) {
  hal::DeviceCaps caps;
  caps.workspace_min = {-0.03, -0.03, -0.03};
  caps.workspace_max = {0.03, 0.04, 0.03};
  Seen seat;
  RateControlAdapter hand{seat, caps};
  for (int i = 0; i <= 2000; ++i) hand.tick(moving(Time{i * 1ms}, {0.1, 0.1, 0}));
  EXPECT_EQ(seat.last.x[0], 0.03);
  EXPECT_EQ(seat.last.x[1], 0.04);
  EXPECT_EQ(seat.last.dx[0], 0.0);
}

TEST(RateControlAdapter, BoundsTheStepAfterAPauseAndTreatsNanAsRest) {
  Seen seat;
  RateControlAdapter hand{seat, {}};
  hand.tick(moving(Time{0ms}, {0.1, 0, 0}));
  hand.tick(moving(Time{900ms}, {0.1, 0, 0}));
  EXPECT_NEAR(seat.last.x[0], 0.0005, 1e-12);
  hand.tick(moving(Time{901ms}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_NEAR(seat.last.x[0], 0.0005, 1e-12);
  EXPECT_TRUE(seat.last.dx.allFinite());
}

TEST(RateControlAdapter, ReportsAPoseDeviceToTheSeatAndForwardsItsLoss) {
  hal::DeviceCaps device;
  device.input = hal::InputKind::kRate;
  const hal::DeviceCaps caps = RateControlAdapter::adapted_caps(device);
  EXPECT_EQ(caps.joints, 3U);
  EXPECT_EQ(caps.tip_axes, 3U);
  EXPECT_TRUE(caps.prismatic);
  EXPECT_EQ(caps.input, hal::InputKind::kPose);
  Seen seat;
  RateControlAdapter hand{seat, device};
  hal::State quiet = moving(Time{1ms}, {0, 0, 0});
  quiet.stale = true;  // the device's velocity has decayed to zero
  const hal::Command command = hand.tick(quiet);
  EXPECT_FALSE(seat.last.stale);
  EXPECT_EQ(command.kind, hal::CommandKind::kNone);  // the device has no motors
  hand.lost(hal::Errc::kUnplugged);
  EXPECT_EQ(seat.losses.size(), 1U);
}

TEST(RateControlAdapter, WorksWithoutHeap) {
  Seen seat;
  RateControlAdapter hand{seat, {}};
  const test::AllocGuard guard;
  for (int i = 0; i < 1000; ++i) hand.tick(moving(Time{i * 1ms}, {0.1, 0, 0}));
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::client
