#include "common/control/channel_set_position.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "common/control/channel_raw.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

/// One axis of constant stiffness 1000 N/m without a gain schedule, for values that a reader can verify by hand.
ChannelParams plain(double e0 = 0.05) {
  ChannelParams p;
  p.dof = 1;
  p.e0 = e0;
  p.schedule.k = p.schedule.k_min = 1000;
  p.v_app = 1e9;  // no approach limit
  p.margin_max = 10;
  return p;
}

EndInput towards(double target, double x = 0) {
  EndInput in;
  in.rx.x[0] = target;
  in.x[0] = x;
  return in;
}

TEST(SetPosition, PaysExactlyTheSpringEnergyOfAMove) {
  SetPositionEnd end(plain());
  end.engage({}, 0);
  const EndState& s = end.move(towards(0.008));  // 1/2 1000 0.008^2 = 32 mJ
  EXPECT_DOUBLE_EQ(s.ref[0], 0.008);
  EXPECT_NEAR(s.paid[0], 0.032, 1e-15);
  EXPECT_EQ(s.absorbed[0], 0);
  EXPECT_NEAR(end.ledger(0).margin(), 0.018, 2e-9);
  end.move(towards(-0.002));  // releases 30 mJ, which the other end may spend
  EXPECT_NEAR(s.absorbed[0], 0.030, 1e-15);
  EXPECT_EQ(s.paid[0], 0);
  EXPECT_EQ(end.ledger(0).in_nj(), 0U);  // until the owner credits it
  end.credit(0, s.absorbed[0]);
  EXPECT_NEAR(1e-9 * static_cast<double>(end.e_in()[0]), 0.030, 1e-9);
  EXPECT_NEAR(end.ledger(0).margin(), 0.018, 2e-9);
}

TEST(SetPosition, MovesOnlyAsFarAsItsBudgetAllows) {
  SetPositionEnd end(plain(0.05));
  end.engage({}, 0);
  const EndState& s = end.move(towards(-0.02));  // wants 200 mJ, has 50 mJ: 1/2 k e^2 = 50 mJ at 10 mm
  EXPECT_NEAR(s.ref[0], -0.01, 1e-9);
  EXPECT_NEAR(s.paid[0], 0.05, 2e-9);
  EXPECT_NEAR(end.refused(), 0.15, 1e-8);
  EXPECT_TRUE(end.ledger(0).holds());
  EXPECT_LE(end.ledger(0).margin_nj(), 2U);
  const double stuck = s.ref[0];
  end.move(towards(-0.02));
  EXPECT_NEAR(s.ref[0], stuck, 1e-9);
  EndInput in = towards(-0.02);
  in.rx.e_in[0] = 30'000'000;  // the other end absorbed 30 mJ: sqrt(2 (50 + 30) mJ / k)
  end.move(in);
  EXPECT_NEAR(s.ref[0], -std::sqrt(2 * 0.08 / 1000), 1e-8);
}

TEST(SetPosition, SpendsOnlyAShareOfItsOwnDissipation) {
  SetPositionEnd end(plain(0));
  end.engage({}, 0);
  EndInput in = towards(1);
  in.dissipated[0] = 0.02;
  EXPECT_NEAR(end.move(in).ref[0], std::sqrt(2 * 0.9 * 0.02 / 1000), 1e-8);
}

TEST(SetPosition, CountsEverySpringThisEndLoads) {
  SetPositionEnd end(plain(1));
  end.engage({}, 0);
  EndInput in = towards(0.008);
  in.weight = 2;
  EXPECT_NEAR(end.move(in).paid[0], 0.064, 1e-15);
}

TEST(SetPosition, MovesWithoutBudgetByAtMostTheApproachStep) {
  ChannelParams p = plain(0.05);
  p.v_app = 0.1;
  SetPositionEnd end(p);
  end.engage({}, 0);
  double ref = 0;
  for (int i = 0; i < 5000; ++i) {  // farther than 50 mJ pay for; then the target jumps to the other side
    const double after = end.move(towards(i < 1000 ? 0.05 : -0.05)).ref[0];
    ASSERT_LE(std::abs(after - ref), 0.1 * 0.001 + 1e-15) << i;
    ref = after;
  }
  EXPECT_LE(std::abs(ref), 0.1 * 0.001);  // its stored energy went to the other end: none is left for the far side
  SetPositionEnd unbounded(plain(0.05));
  unbounded.engage({}, 0);
  unbounded.move(towards(0.05));
  EXPECT_NEAR(unbounded.move(towards(-0.05)).ref[0], -0.01, 1e-8);  // at dE = 0: the reason for the approach limit
}

TEST(SetPosition, NeverClipsMotionItself) {
  ChannelParams p = plain(10);
  p.v_app = 0.1;
  SetPositionEnd end(p);
  end.engage({}, 0);
  EndInput in = towards(0);
  for (int i = 1; i <= 50; ++i) {
    in.rx.v[0] = 2;
    in.rx.x[0] = 0.002 * i;
    ASSERT_NEAR(end.move(in).ref[0], 0.002 * i, 1e-12);
  }
}

TEST(SetPosition, TakesAStiffnessChangeThroughTheLedger) {
  ChannelParams p = plain(0.1);
  p.schedule.k_min = 60;
  p.schedule.k_delay = 5;
  SetPositionEnd end(p);
  end.engage({}, 0.05);  // 5 / 0.05 = 100 N/m
  EndInput in = towards(0.03);
  in.age = 0.05;
  const EndState& s = end.move(in);
  ASSERT_NEAR(s.k[0], 100, 0.01);
  double paid = s.paid[0], absorbed = 0, k = s.k[0];
  in.age = 0;
  for (int i = 0; i < 3000; ++i) {  // stiffer as the delay falls: paid, until the balance is empty
    const double r = s.ref[0];
    end.move(in);
    const double energy = 0.5 * s.k[0] * s.ref[0] * s.ref[0] - 0.5 * k * r * r;
    ASSERT_NEAR(s.paid[0] - s.absorbed[0], energy, 1e-12) << i;
    paid += s.paid[0];
    absorbed += s.absorbed[0];
    k = s.k[0];
  }
  EXPECT_GT(k, 150);
  EXPECT_NEAR(paid - absorbed, 0.5 * k * s.ref[0] * s.ref[0], 1e-9);
  EXPECT_LE(paid, 0.1 + 1e-9);
}

TEST(SetPosition, YieldsToAHandThatPushesHarderThanTheMotor) {
  ChannelParams p = plain(10);
  p.effort_max = 3.3;
  SetPositionEnd end(p);
  end.engage({}, 0);
  const EndState& s = end.move(towards(0.01));
  EXPECT_NEAR(s.k[0] * (s.ref[0] - 0), 3.3, 1e-12);
  end.move(towards(0, 0.02));  // the hand is 20 mm away
  EXPECT_NEAR(s.k[0] * (s.ref[0] - 0.02), -3.3, 1e-12);
}

TEST(SetPosition, YieldsWhileItsOtherEndIsSilentAndMovesNoEnergy) {
  ChannelParams p = plain();
  p.effort_max = 3;  // 3 mm at 1000 N/m
  SetPositionEnd end(p);
  end.engage({}, 0);
  end.move(towards(0.002));
  const std::uint64_t margin = end.ledger(0).margin_nj();
  AxisArray x{};
  for (const auto& [at, ref] : {std::pair{0.001, 0.002}, std::pair{-0.001, 0.002}, std::pair{-0.004, -0.001},
                                std::pair{0.001, -0.001}, std::pair{0.006, 0.003}}) {
    x[0] = at;
    end.clamp_reference(x);
    EXPECT_NEAR(end.state().ref[0], ref, 1e-12) << at;
    EXPECT_EQ(end.state().absorbed[0], 0);
    EXPECT_EQ(end.ledger(0).margin_nj(), margin);
    EXPECT_EQ(end.ledger(0).in_nj(), 0U);
  }
  x[0] = std::numeric_limits<double>::quiet_NaN();
  end.clamp_reference(x);
  EXPECT_NEAR(end.state().ref[0], 0.003, 1e-12);
}

TEST(SetPosition, StartsAgainWithoutElongationAndWithoutCredit) {
  SetPositionEnd end(plain());
  end.engage({}, 0);
  end.move(towards(0.008));
  const auto in = end.e_in(), out = end.e_out();
  end.engage({0.5}, 0);
  EXPECT_EQ(end.state().ref[0], 0.5);
  EXPECT_EQ(end.e_in(), in);
  EXPECT_EQ(end.e_out(), out);
}

TEST(SetPosition, PredictsAheadByTheAgeOfTheMessage) {
  ChannelParams p = plain(10);
  SetPositionEnd end(p);
  end.engage({}, 0);
  EndInput in = towards(0.01);
  in.age = 0.03;
  in.rx.v[0] = 0.2;
  EXPECT_NEAR(end.move(in).ref[0], 0.016, 1e-12);
  in.age = 5;  // extrapolated by at most 100 ms
  EXPECT_NEAR(end.move(in).ref[0], 0.03, 1e-12);
}

TEST(SetPosition, MixesInTheEffortOnlyAtTheServerAndOnlyWithDelay) {
  for (const Side side : {Side::kClient, Side::kServer}) {
    for (const double age : {0.0, 0.05, 0.5}) {
      ChannelParams p = plain(100);
      p.side = side;
      SetPositionEnd end(p);
      end.engage({}, age);
      EndInput in = towards(0.01, 0.002);
      in.age = age;
      in.rx.f[0] = 4;
      const bool mixed = side == Side::kServer && age == 0.05;
      EXPECT_NEAR(end.move(in).ref[0], mixed ? 0.5 * 0.01 + 0.5 * (0.002 + 4.0 / 1000) : 0.01, 1e-12) << age;
    }
  }
}

TEST(SetPosition, StaysFiniteForEveryInput) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), 1e200, -1e308};
  const std::uint64_t last = test::seeds(100);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    ChannelParams p = plain();
    p.v_app = random.below(2) == 0 ? 0.1 : 1e9;
    p.side = random.below(2) == 0 ? Side::kClient : Side::kServer;
    SetPositionEnd end(p);
    end.engage({}, 0.02);
    for (int i = 0; i < 100; ++i) {
      EndInput in = towards(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
      in.age = 0.02;
      double* const fields[] = {&in.rx.x[0], &in.rx.v[0], &in.rx.f[0], &in.x[0], &in.dissipated[0]};
      if (i < 80 && random.below(3) == 0) *fields[random.below(4)] = kBad[random.below(5)];
      if (i < 80 && random.below(9) == 0) *fields[4] = kBad[0];
      const EndState& s = end.move(in);
      ASSERT_TRUE(std::isfinite(s.ref[0]) && std::isfinite(s.k[0])) << i;
      ASSERT_TRUE(end.ledger(0).holds());
    }
  }
}

TEST(SetPosition, MovesWithoutHeap) {
  SetPositionEnd end(plain());
  end.engage({}, 0);
  const test::AllocGuard guard;
  for (int i = 0; i < 1000; ++i) end.move(towards(0.001 * (i % 7)));
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::control
