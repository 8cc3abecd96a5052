#include "hal/driver_guard.h"

#include <gtest/gtest.h>

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Three orthogonal linear axes of 8 N, asked once a millisecond, past the soft start: joint effort is tip force.
struct Guarded {
  Guarded() {
    state.J.leftCols<3>() = Eigen::Matrix3d::Identity();
    guard.start(now);
    for (int ms = 0; ms < 600; ++ms) pass({static_cast<std::uint64_t>(ms), now + 5ms, CommandKind::kJointEffort, {}});
  }
  /// Force of the exchange a millisecond later [N].
  double pass(const Command& command) {
    now += 1ms;
    guard.see(now, state, true);
    out = guard.pass(now, command, state);
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

// A client that hangs in its own loop repeats its last words: they are worth 30 ms, whatever they promise.
TEST(DriverGuard, NoCommandOutlivesTheCeilingHoweverOftenItIsRepeated) {
  Guarded g;
  const Command forever{1000, g.now + 1h, CommandKind::kJointEffort, kPush};
  for (int ms = 0; ms < 29; ++ms) ASSERT_EQ(g.pass(forever), 4) << ms;
  g.pass(forever);
  double before = 4;
  for (int ms = 0; ms < 21; ++ms) {
    const double force = g.pass(forever);
    EXPECT_EQ(g.out.verdict, DriverGuard::Verdict::kExpired);
    EXPECT_LT(force, before) << ms;
    before = std::max(force, 1e-9);
  }
  EXPECT_EQ(g.pass(forever), 0) << "gone within 20 ms, and it stays so";
  EXPECT_EQ(g.pass({1001, g.now + 5ms, CommandKind::kJointEffort, kPush}), 4) << "a new command counts";
}

TEST(DriverGuard, ACommandOfASlowSceneActsFromTickToTick) {
  Guarded g;
  std::uint64_t seq = 1000;
  for (int tick = 0; tick < 20; ++tick) {  // 100 Hz; the device is asked a thousand times a second
    const Command command{++seq, g.now + command_life(10ms), CommandKind::kJointEffort, kPush};
    for (int ms = 0; ms < (tick == 10 ? 20 : 10); ++ms) ASSERT_EQ(g.pass(command), 4) << "tick " << tick << ", ms " << ms;  // one tick is missed
  }
}

}  // namespace
}  // namespace tandem::hal
