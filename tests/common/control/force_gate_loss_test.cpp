#include <gtest/gtest.h>

#include <algorithm>

#include "tests/common/control/force_gate_drive.h"

/// Conditions that the gate counts as a loss, and its reactions.
namespace tandem::control {
namespace {

using namespace std::chrono_literals;
using test::GateDrive;

TEST(ForceGate, TreatsSilenceAsLossAtExactlyItsLimit) {
  GateDrive d;
  d.hold(2);
  d.in.fresh = false;
  d.ticks(19);
  EXPECT_EQ(d.gate.trips(), 0U);
  EXPECT_NEAR(d.out.effort[0], 2, 1e-9);
  EXPECT_TRUE(d.tick().tripped);  // 20 ms after the last fresh datagram
  EXPECT_EQ(d.gate.phase(), GatePhase::kReleasing);
  EXPECT_FALSE(d.tick().tripped);
  EXPECT_EQ(d.gate.trips(), 1U);
}

TEST(ForceGate, RestartsTheSilenceTimerWithEveryFreshDatagram) {
  GateDrive d;
  d.hold(2);
  for (int i = 0; i < 2000; ++i) {
    d.in.fresh = i % 20 == 19;
    d.tick();
  }
  EXPECT_EQ(d.gate.trips(), 0U);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
}

TEST(ForceGate, ReleasesItsForceWithin120Milliseconds) {
  GateDrive d;
  d.hold(3);
  d.in.fresh = false;
  double before = d.out.effort[0];
  for (int ms = 1; ms <= 120; ++ms) {
    d.tick();
    ASSERT_LE(d.out.effort[0], before + 1e-9) << ms;              // never rises
    ASSERT_GE(d.out.effort[0], before - 3.0 / 100 - 1e-9) << ms;  // never drops either, while the hand is at rest
    before = d.out.effort[0];
  }
  EXPECT_EQ(d.out.effort[0], 0);
  d.in.v[0] = 0.1;  // the remaining effort is damping
  d.in.fresh = true;
  d.in.engage = false;
  for (int i = 0; i < 50; ++i) EXPECT_LE(d.tick().effort[0], 0);
}

TEST(ForceGate, EndsItsRampInTimeDespiteLateDetection) {
  GateDrive on_time, late;
  for (GateDrive* d : {&on_time, &late}) {
    d->hold(3);
    d->in.fresh = false;
  }
  on_time.ticks(34);
  late.ticks(19);
  late.in.now += 14ms;  // the program was not scheduled
  EXPECT_TRUE(late.tick().tripped);
  EXPECT_NEAR(late.out.effort[0], on_time.out.effort[0], 1e-9);
  EXPECT_NEAR(late.out.effort[0], 3 * 0.86, 1e-9) << "14 ms of 100";
  late.ticks(86);
  EXPECT_EQ(late.out.effort[0], 0) << "120 ms after the last fresh datagram";
}

TEST(ForceGate, GivesNoMoreThanItsTankAtIrregularWakeUps) {
  for (const int silence : {0, 1, 2, 3}) {  // the irregular step at which the link is lost
    GateDrive d;
    d.hold(3);
    double given = 0, most = 0;
    const auto wake = [&](int n) {
      constexpr Duration kSteps[] = {1ms, 4ms, 1ms, 2ms};
      const Duration step = kSteps[n % 4];
      const double before = d.out.effort[0];
      d.in.now += step - 1ms;
      d.in.q[0] += 0.65 * seconds(step);  // along the effort of the motor
      d.in.v[0] = 0.65;
      d.tick();
      given += before * 0.65 * seconds(step);
      most = std::max(most, given);
    };
    for (int n = 0; n < 400 + silence; ++n) wake(n);
    given = most = 0;
    d.in.fresh = false;
    for (int n = 400 + silence; n < 600; ++n) wake(n);
    EXPECT_EQ(d.out.effort[0], -5 * 0.65) << "damping is left";
    EXPECT_GT(most, 0.5 * d.gate.tank().size()) << silence;
    EXPECT_LE(most, d.gate.tank().size() + 1e-5) << silence;
  }
}

TEST(ForceGate, KeepsDampingWithoutALink) {  // a hand that pushed moves fastest when the ramp ends
  GateDrive d;
  d.hold(2);
  d.in.fresh = false;
  d.in.v[0] = -0.2;
  d.ticks(300);
  EXPECT_NEAR(d.out.effort[0], 1, 1e-9);
  d.in.fresh = true;
  d.ticks(2);
  EXPECT_EQ(d.gate.phase(), GatePhase::kRampIn);  // and yields to the link at once
}

// Example: a switch that holds datagrams back and releases them in order.
TEST(ForceGate, TreatsAnOldLoopAsLossDespiteFreshDatagrams) {
  GateDrive d;
  d.hold(2);
  EXPECT_EQ(d.gate.loop_age_limit(), 22ms);  // p99 + 20 ms
  d.in.loop_age = 22ms;
  d.ticks(100);
  EXPECT_EQ(d.gate.trips(), 0U);
  d.in.loop_age = 22ms + 1us;
  EXPECT_TRUE(d.tick().tripped);
  d.ticks(200);
  EXPECT_EQ(d.out.effort[0], 0);
  EXPECT_FALSE(d.gate.active());
  d.in.loop_age = 5ms;
  d.tick();
  EXPECT_EQ(d.gate.phase(), GatePhase::kZero);
  EXPECT_TRUE(d.tick().engaged_now);  // low age again, and engagement requested
}

TEST(ForceGate, AdaptsItsAgeLimitSlowlyOnceEngaged) {
  GateDrive d;
  d.in.engage = false;
  d.in.rtt_p99 = 60ms;
  d.ticks(2);
  EXPECT_EQ(d.gate.loop_age_limit(), 80ms);
  d.in.rtt_p99 = 3s;  // never above the scene's limit
  d.ticks(2);
  EXPECT_EQ(d.gate.loop_age_limit(), 100ms);
  d.in.rtt_p99 = 0ms;
  d.ticks(2);
  EXPECT_EQ(d.gate.loop_age_limit(), 20ms);  // never below 20 ms
  d.in.engage = true;
  d.ticks(5);
  d.in.rtt_p99 = 60ms;
  d.ticks(1000);
  EXPECT_NEAR(seconds(d.gate.loop_age_limit()), 0.030, 1e-6);  // 10 ms per second
  d.in.rtt_p99 = 0ms;
  d.ticks(500);
  EXPECT_NEAR(seconds(d.gate.loop_age_limit()), 0.025, 1e-6);
}

/// Causes one loss, waits 150 ms at rest, then stays engaged until `period` ms have passed.
void lose_once(GateDrive& d, int period) {
  d.in.fresh = false;
  d.ticks(30);
  d.in.fresh = true;
  d.ticks(period - 30);
}

TEST(ForceGate, LatchesAfterThreeLossesInTenSeconds) {
  GateDrive d;
  d.ticks(700);
  lose_once(d, 4900);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
  lose_once(d, 4900);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
  lose_once(d, 4900);  // 9.8 s after the first
  EXPECT_EQ(d.gate.phase(), GatePhase::kLatched);
  EXPECT_EQ(d.gate.trips(), 3U);
  d.in.v[0] = 0.2;
  d.in.wanted[0] = 3;
  d.tick();
  EXPECT_NEAR(d.out.effort[0], -1, 1e-9);  // 5 N s/m and no other effort
  d.in.v[0] = 0;
  d.in.reset = true;
  d.tick();
  EXPECT_EQ(d.gate.phase(), GatePhase::kZero);
  EXPECT_TRUE(d.tick().engaged_now);
}

TEST(ForceGate, DoesNotLatchWhenThreeLossesTakeElevenSeconds) {
  GateDrive d;
  d.ticks(700);
  for (int i = 0; i < 8; ++i) lose_once(d, 5500);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
  EXPECT_EQ(d.gate.trips(), 8U);
}

TEST(ForceGate, DoesNotLatchIfTheSceneDisablesIt) {
  GateParams p;
  p.latch = false;
  GateDrive d(p);
  d.ticks(700);
  for (int i = 0; i < 5; ++i) lose_once(d, 1000);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
}

TEST(ForceGate, RampsOutBeforeItDamps) {  // the third loss latches, but the effort still ramps out
  GateDrive d;
  d.in.wanted[0] = 3;
  d.ticks(700);
  lose_once(d, 1000);
  lose_once(d, 1000);
  d.in.fresh = false;
  d.ticks(20);
  ASSERT_EQ(d.gate.phase(), GatePhase::kLatched);
  EXPECT_NEAR(d.out.effort[0], 3, 0.05);
  d.ticks(50);
  EXPECT_NEAR(d.out.effort[0], 1.5, 0.05);
  d.ticks(50);
  EXPECT_EQ(d.out.effort[0], 0);
}

}  // namespace
}  // namespace tandem::control
