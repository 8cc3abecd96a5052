#include "hal/core/driver_guard.h"

#include <gtest/gtest.h>

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Guard of three orthogonal linear axes of 8 N, called once a millisecond after the soft start: joint effort is tip
/// force.
struct Guarded {
  Guarded() {
    state.J.leftCols<3>() = Eigen::Matrix3d::Identity();
    guard.start(now);
    for (int ms = 0; ms < 600; ++ms) limit({static_cast<std::uint64_t>(ms), now + 5ms, CommandKind::kJointEffort, {}});
  }
  /// Returns the force of the exchange one millisecond later [N].
  double limit(const Command& command) {
    now += 1ms;
    guard.observe(now, state, true);
    out = guard.limit(now, command, state);
    return std::hypot(out.effort[0], out.effort[1], out.effort[2]);
  }
  static GuardLimits limits() {
    GuardLimits all;
    all.peak_n = 8;
    return all;
  }
  Time now{10s};
  State state;
  DriverGuard guard{limits(), 3};
  DriverGuard::Output out;
};

constexpr AxisArray kPush{4};

// A client that hangs in its own loop repeats its last command. That command acts for at most 30 ms, whatever expiry it
// requests.
TEST(DriverGuard, ExpiresARepeatedCommandAtTheCeiling) {
  Guarded g;
  const Command forever{1000, g.now + 1h, CommandKind::kJointEffort, kPush};
  for (int ms = 0; ms < 29; ++ms) ASSERT_EQ(g.limit(forever), 4) << ms;
  g.limit(forever);
  double before = 4;
  for (int ms = 0; ms < 21; ++ms) {
    const double force = g.limit(forever);
    EXPECT_EQ(g.out.verdict, DriverGuard::Verdict::kExpired);
    EXPECT_LT(force, before) << ms;
    before = std::max(force, 1e-9);
  }
  EXPECT_EQ(g.limit(forever), 0) << "gone within 20 ms, and it stays so";
  EXPECT_EQ(g.limit({1001, g.now + 5ms, CommandKind::kJointEffort, kPush}), 4) << "a new command counts";
}

TEST(DriverGuard, KeepsACommandOfASlowSceneFromTickToTick) {
  Guarded g;
  std::uint64_t seq = 1000;
  for (int tick = 0; tick < 20; ++tick) {  // 100 Hz; the device has 1000 exchanges a second
    const Command command{++seq, g.now + command_lifetime(10ms), CommandKind::kJointEffort, kPush};
    for (int ms = 0; ms < (tick == 10 ? 20 : 10); ++ms)
      ASSERT_EQ(g.limit(command), 4) << "tick " << tick << ", ms " << ms;  // one tick is missed
  }
}

}  // namespace
}  // namespace tandem::hal
