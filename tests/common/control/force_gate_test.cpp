#include "common/control/force_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/common/control/force_gate_drive.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

using namespace std::chrono_literals;
using test::GateDrive;

TEST(ForceGate, StaysFiniteAndWithinTheMotorForEveryInput) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  constexpr double kBad[] = {kNan, kInf, -kInf, 1e308, -1e308, 1e160, 5e-324};
  const std::uint64_t last = tandem::test::seeds(100);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    GateParams p;
    p.dof = 1 + random.below(kAxesMax);
    for (double& s : p.scale) s = std::pow(10.0, random.uniform(-2, 0));
    p.force_max = random.uniform(0.5, 20);
    GateDrive d(p);
    for (int i = 0; i < 2000; ++i) {
      d.in.fresh = random.below(20) != 0;
      d.in.loop_age = random.below(200) == 0 ? 1h : 3ms;
      d.in.engage = random.below(300) != 0;
      d.in.reset = random.below(50) == 0;
      d.in.reading_valid = random.below(500) != 0;
      for (std::size_t a = 0; a < p.dof; ++a) {
        d.in.wanted[a] = random.uniform(-30, 30);
        d.in.q[a] = random.uniform(-0.1, 0.1);
        d.in.v[a] = random.uniform(-1, 1);
      }
      AxisArray* const fields[] = {&d.in.wanted, &d.in.q, &d.in.v};
      if (random.below(10) == 0) (*fields[random.below(3)])[random.below(p.dof)] = kBad[random.below(7)];
      if (random.below(100) == 0) d.in.now -= 20ms;  // a clock that runs backwards
      const auto out = d.tick();
      for (const double f : out.effort) ASSERT_TRUE(std::isfinite(f)) << "tick " << i;
      ASSERT_LE(test::norm(out.effort, p), p.force_max * (1 + 1e-9)) << "tick " << i;
      ASSERT_FALSE(std::isnan(d.gate.tank().given()));
    }
  }
}

TEST(ForceGate, GivesZeroForANonFiniteEffortAndContinues) {
  GateDrive d;
  d.hold(2);
  d.in.wanted[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(d.tick().not_finite);
  EXPECT_EQ(d.out.effort, AxisArray{});
  EXPECT_EQ(d.gate.not_finite(), 1U);
  d.in.wanted[1] = 0;
  EXPECT_NEAR(d.tick().effort[0], 1, 1e-9);  // rises again at 1 N/ms
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
}

TEST(ForceGate, ClampsTheNormAndKeepsTheDirection) {
  GateParams p;
  p.scale = {0.02, 0.01, 0.04, 1, 1, 1, 1};
  GateDrive d(p);
  d.in.wanted = {3, -1, 2};
  d.ticks(700);
  EXPECT_TRUE(d.out.clipped);
  EXPECT_NEAR(test::norm(d.out.effort, p), p.force_max, 1e-9);
  EXPECT_NEAR(d.out.effort[0] / d.out.effort[1], -3, 1e-9);
  EXPECT_NEAR(d.out.effort[2] / d.out.effort[1], -2, 1e-9);
  d.in.wanted = {0.01, 0, 0};
  d.ticks(10);
  EXPECT_FALSE(d.out.clipped);
}

TEST(ForceGate, SlewsOneNewtonPerMillisecond) {
  const std::uint64_t last = tandem::test::seeds(50);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    GateParams p;
    p.scale = {0.02, 0.01, 0.04, 1, 1, 1, 1};
    p.force_max = 7.9;
    GateDrive d(p);
    d.ticks(600);
    ASSERT_EQ(d.gate.phase(), GatePhase::kActive);
    for (int i = 0; i < 500; ++i) {
      const AxisArray before = d.out.effort;
      if (random.below(3) == 0)
        for (std::size_t a = 0; a < 3; ++a) d.in.wanted[a] = random.uniform(-2, 2);
      AxisArray change = d.tick().effort;
      for (std::size_t a = 0; a < 3; ++a) change[a] -= before[a];
      ASSERT_LE(test::norm(change, p), 1 + 1e-9) << i;
      ASSERT_LE(test::norm(d.out.effort, p), p.force_max + 1e-9);
    }
  }
}

TEST(ForceGate, RampsInWithoutABump) {
  GateDrive d;
  d.in.wanted[0] = 3;
  double before = 0;
  EXPECT_TRUE(d.tick().engaged_now);
  EXPECT_EQ(d.gate.phase(), GatePhase::kRampIn);
  for (int i = 1; i < 500; ++i) {
    EXPECT_FALSE(d.tick().engaged_now);
    ASSERT_EQ(d.gate.phase(), GatePhase::kRampIn);
    ASSERT_LE(std::abs(d.out.effort[0] - before), 0.01 + 1e-12) << i;  // 10 N/s
    ASSERT_LE(d.out.effort[0], 3.0 * i / 500 + 1e-9) << i;             // gain 0 to 1 in 0.5 s
    before = d.out.effort[0];
  }
  d.ticks(10);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
  EXPECT_NEAR(d.out.effort[0], 3, 1e-9);
}

TEST(ForceGate, ReportsTheShareThatTheSlewOfTheRampHoldsBack) {
  GateDrive d;
  d.ticks(250);
  EXPECT_EQ(d.out.held_back[0], 0);
  d.in.wanted[0] = 3;  // half of it at once, where 0.01 N are allowed
  d.tick();
  EXPECT_NEAR(d.out.held_back[0], 1 - d.out.effort[0] / 1.5, 0.01);
  EXPECT_GT(d.out.held_back[0], 0.98);
  EXPECT_EQ(d.out.held_back[1], 0);
  d.in.wanted[0] = 0;  // the effort is above the wanted one: nothing is held back
  d.tick();
  EXPECT_EQ(d.out.held_back[0], 0);
  d.ticks(500);
  EXPECT_EQ(d.gate.phase(), GatePhase::kActive);
  d.in.wanted[0] = 3;
  d.tick();
  EXPECT_EQ(d.out.held_back[0], 0) << "the ramp is over";
}

TEST(ForceGate, CatchesAHandFoundInMotion) {
  GateDrive d;
  d.in.v[0] = 0.3;
  d.ticks(50);
  EXPECT_LT(d.out.effort[0], 0);  // damping while the spring force ramps in
  d.in.v[0] = 0;
  d.ticks(600);
  d.in.v[0] = 0.3;
  d.ticks(5);
  EXPECT_EQ(d.out.effort[0], 0);  // no damping once the spring force is complete
}

TEST(ForceGate, EngagesOnlyWhenRequestedConnectedAndFresh) {
  for (int reason = 0; reason < 3; ++reason) {
    GateDrive d;
    d.in.wanted[0] = 2;
    d.in.engage = reason != 0;
    d.in.fresh = reason != 1;
    d.in.loop_age = reason == 2 ? 1s : 1ms;
    for (int i = 0; i < 300; ++i) {
      ASSERT_FALSE(d.tick().engaged_now) << reason;
      ASSERT_EQ(d.out.effort, AxisArray{}) << reason;
    }
    EXPECT_EQ(d.gate.trips(), 0U);
  }
}

TEST(ForceGate, ReleasesOnRequestThroughTheRampWithoutALoss) {
  GateDrive d;
  d.hold(2);
  d.in.engage = false;
  d.tick();
  EXPECT_EQ(d.gate.phase(), GatePhase::kReleasing);
  EXPECT_FALSE(d.out.tripped);
  EXPECT_NEAR(d.out.effort[0], 2, 0.05);
  d.ticks(50);
  EXPECT_NEAR(d.out.effort[0], 1, 0.05);
  d.ticks(60);
  EXPECT_EQ(d.out.effort[0], 0);
  EXPECT_EQ(d.gate.phase(), GatePhase::kReleasing) << "a hand that pushed is still caught";
  d.in.v[0] = 0.2;
  d.tick();
  EXPECT_NEAR(d.out.effort[0], -1, 1e-9) << "5 N s/m";
  d.in.v[0] = 0;
  d.ticks(400);
  EXPECT_EQ(d.gate.phase(), GatePhase::kZero);
  EXPECT_EQ(d.gate.trips(), 0U);
  d.in.engage = true;
  EXPECT_TRUE(d.tick().engaged_now);
}

TEST(ForceGate, HoldsNoStaleForceAfterAProgramStall) {
  for (const Duration standstill : {30ms, 500ms}) {
    GateDrive d;
    d.hold(2);
    d.in.now += standstill;  // the previous command expired by its age, and the driver has released
    d.in.loop_age = standstill;
    EXPECT_TRUE(d.tick().tripped);
    for (int i = 0; i < 200; ++i)
      EXPECT_EQ(d.tick().effort, AxisArray{}) << "no ramp of a force that is no more, tick " << i;
  }
}

TEST(ForceGate, KeepsTheEnergyAccountOfALossUntilItReengages) {
  // An unstable link: one datagram during the ramp renews the link, but the effort that ramps out is still stale.
  GateDrive d;
  d.hold(3);
  d.in.fresh = false;
  d.ticks(25);
  ASSERT_EQ(d.gate.phase(), GatePhase::kReleasing);
  d.in.q[0] += 0.002;  // the motor pushes the hand: 3 N over 2 mm
  d.tick();
  const double given = d.gate.tank().given();
  ASSERT_GT(given, 0.003);
  d.in.fresh = true;
  d.tick();
  EXPECT_GE(d.gate.tank().given(), given);
}

TEST(ForceGate, FaultsAtOnceAndUntilReset) {
  GateDrive d;
  d.hold(3);
  d.in.reading_valid = false;
  d.tick();
  EXPECT_EQ(d.gate.phase(), GatePhase::kFault);
  EXPECT_EQ(d.out.effort, AxisArray{});
  d.in.reset = true;
  d.tick();
  EXPECT_EQ(d.gate.phase(), GatePhase::kFault);  // the reading is still invalid
  d.in.reading_valid = true;
  d.ticks(100);
  EXPECT_EQ(d.gate.phase(), GatePhase::kFault);
  EXPECT_EQ(d.out.effort, AxisArray{});
  d.in.reset = true;
  d.tick();
  EXPECT_EQ(d.gate.phase(), GatePhase::kZero);
  EXPECT_TRUE(d.tick().engaged_now);
}

TEST(ForceGate, WorksWithoutHeap) {
  GateDrive d;
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 3000; ++i) {
    d.in.fresh = i % 700 < 600;
    d.in.wanted[0] = 2;
    d.tick();
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::control
