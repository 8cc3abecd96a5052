#include "common/control/channel_replica.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/control/hand_motion.h"

namespace tandem::control {
namespace {

ChannelParams one_axis() {
  ChannelParams p;
  p.dof = 1;
  p.k_c = 400;
  p.b_rel = 12;
  p.effort_max = 3.3;
  p.v_app = 1e9;  // no approach limit
  p.margin_max = 10;
  return p;
}

EndInput hears(double r, double authority, double age = 0.0005) {
  EndInput in;
  in.rx.x[0] = r;
  in.authority = authority;
  in.age = age;
  return in;
}

/// Moves the end until stiffness has reached the value for delay and authority.
const EndState& settled(ReplicaReference& end, const EndInput& in) {
  end.engage({}, in.age);
  for (int i = 0; i < 3000; ++i) end.move(in);
  return end.state();
}

TEST(ReplicaReference, HasNoCouplingAtASeatThatLeadsAlone) {
  ReplicaReference end(one_axis());
  const EndState& s = settled(end, hears(0.005, 1));
  EXPECT_EQ(s.k[0], 0);
  EXPECT_EQ(s.b[0], 0);
  EXPECT_EQ(end.ledger(0).out_nj(), 0u) << "so nothing is paid";
}

TEST(ReplicaReference, HasTheFullSpringAtAFollowerForAnyDelay) {
  for (const double delay : {0.001, 0.1, 0.5}) {
    ReplicaReference end(one_axis());
    const EndState& s = settled(end, hears(0.005, 0, delay));
    EXPECT_NEAR(s.k[0], 400, 1e-9) << delay;
    EXPECT_NEAR(s.b[0], 1.25 * 12, 1e-9) << delay;
  }
}

// The device of a SLAVE seat also pulls a hand that leads alone. This pull is paid like any move of r.
TEST(ReplicaReference, AddsThePullOfASlaveDevice) {
  ReplicaReference end(one_axis());
  EndInput in = hears(0.002, 1, 0.0505);
  in.slave_pull = 0.25;
  const EndState& s = settled(end, in);
  EXPECT_NEAR(s.k[0], 0.25 * 400, 1e-9);
  EXPECT_NEAR(s.b[0], 0.5 * 100 * 0.05, 5e-3);
  EXPECT_NEAR(1e-9 * static_cast<double>(end.ledger(0).out_nj()), 0.5 * 100 * 0.002 * 0.002, 1e-8);
  in.slave_pull = std::numeric_limits<double>::infinity();
  EXPECT_LE(settled(end, in).k[0], 400);
}

// kappa / 2 d = 2 / (2 * 0.1) = 10 N/m, half of it at half authority. Damping relative to the others scales by the same
// ratio, and 0.5 k d is added.
TEST(ReplicaReference, CouplesSharingSeatsAsStiffAsTheDelayAllows) {
  ReplicaReference end(one_axis());
  const EndState& s = settled(end, hears(0.005, 0.5, 0.1005));
  EXPECT_NEAR(s.k[0], 0.5 * 10, 5e-3);
  EXPECT_NEAR(s.b[0], 0.5 * 12 * 10 / 400 + 0.5 * 0.5 * 10 * 0.1, 5e-3);
  ReplicaReference near(one_axis());
  EXPECT_NEAR(settled(near, hears(0.005, 0.5, 0.0025)).k[0], 0.5 * 400, 1e-6)
      << "2 ms allow 500 N/m, more than the spring has";
}

TEST(ReplicaReference, PaysExactlyWhatAMoveStores) {
  ReplicaReference end(one_axis());
  settled(end, hears(0, 0));
  const double before = end.ledger(0).margin();
  end.move(hears(0.01, 0));  // 1/2 400 0.01^2 = 20 mJ
  EXPECT_NEAR(before - end.ledger(0).margin(), 0.02, 1e-8);
  end.move(hears(0, 0));
  EXPECT_NEAR(before - end.ledger(0).margin(), 0, 1e-8) << "and gets it back, to spend again";
}

TEST(ReplicaReference, MovesNoFartherThanItsBudget) {
  ReplicaReference end(one_axis());
  settled(end, hears(0, 0));
  end.move(hears(0.0165, 0));  // 54 mJ wanted, 50 mJ available
  EXPECT_NEAR(end.state().ref[0], std::sqrt(2 * 0.05 / 400), 1e-6);
  EXPECT_TRUE(end.ledger(0).holds());
  EXPECT_NEAR(end.refused(), 0.5 * 400 * 0.0165 * 0.0165 - 0.05, 1e-6);
}

// The reference stays within 2 F_max / k_c of the copy, for any balance of the ledger. The energy stored in the spring
// therefore stays within the energy that a hand can receive.
TEST(ReplicaReference, StaysNearTheCopyDespiteASufficientBudget) {
  ChannelParams p = one_axis();
  p.e0 = p.margin_max = 100;
  ReplicaReference end(p);
  end.engage({}, 0.0005);
  for (int i = 0; i < 3000; ++i) end.move(hears(0.5, 0));
  EXPECT_DOUBLE_EQ(end.state().ref[0], 2 * 3.3 / 400);
  EndInput moved = hears(0.5, 0);
  moved.x[0] = -0.01;  // the copy moves away: the reference follows
  end.move(moved);
  EXPECT_DOUBLE_EQ(end.state().ref[0], -0.01 + 2 * 3.3 / 400);
  EXPECT_TRUE(end.ledger(0).holds());
}

TEST(ReplicaReference, PredictsForAFollowerAndNotForASharingSeat) {
  EndInput in = hears(0, 0, 0.1);
  in.rx.v[0] = 0.05;
  ReplicaReference follows(one_axis());
  EXPECT_NEAR(settled(follows, in).ref[0], 0.005, 1e-9);
  in.authority = 0.5;
  ReplicaReference shares(one_axis());
  EXPECT_NEAR(settled(shares, in).ref[0], 0, 1e-9);
}

// Through one pole of 7 Hz: after 32 ms a step of velocity counts for 1 - exp(-2 pi 7 0.032) = 76 %. At an age of 200
// ms the pole is at 4.5 Hz.
TEST(ReplicaReference, LeadsAFollowerByTheFilteredVelocity) {
  EndInput in = hears(0, 0, 0.1);
  ReplicaReference end(one_axis()), later(one_axis());
  settled(end, in);
  EndInput old = hears(0, 0, 0.2);
  settled(later, old);
  in.rx.v[0] = old.rx.v[0] = 0.05;
  for (int i = 0; i < 32; ++i) {
    end.move(in);
    later.move(old);
  }
  EXPECT_NEAR(end.state().ref[0], 0.1 * 0.05 * (1 - std::exp(-2 * std::numbers::pi * 7 * 0.032)), 1e-9);
  EXPECT_NEAR(later.state().ref[0], 0.2 * 0.05 * (1 - std::exp(-2 * std::numbers::pi * 4.5 * 0.032)), 1e-9);
  EXPECT_EQ(end.state().rate[0], 0.05) << "the damper needs no prediction";
}

// While the others accelerate, the reference of a follower moves faster than they do: by up to 40 mm/s, in addition to
// v_app. The reference of a sharing hand does not.
TEST(ReplicaReference, BoundsTheAccelerationOfALeadingReference) {
  for (const double authority : {0.0, 0.5}) {
    ChannelParams p = one_axis();
    p.v_app = 0.1;
    ReplicaReference end(p);
    const EndInput still = hears(0, authority, 0.1);
    settled(end, still);
    const double before = end.state().ref[0];
    EndInput in = hears(0.005, authority, 0.1);
    in.rx.v[0] = 0.02;
    EXPECT_NEAR(end.move(in).ref[0] - before, (0.02 + 0.1 + (authority == 0 ? 0.04 : 0)) * 0.001, 1e-12) << authority;
  }
}

TEST(PredictedHand, ConvergesToTheBetterPredictionWithoutAStep) {
  PredictedHand end(one_axis());
  end.engage({}, 0.1);
  EndInput in = hears(0.005, 1, 0.1);
  in.rx.v[0] = 0.02;
  double before = 0;
  for (int i = 0; i < 200; ++i) {
    const double now = end.move(in).ref[0];
    EXPECT_LE(now - before, (0.02 + 0.05) * 0.001 + 1e-12);
    EXPECT_NEAR(end.state().rate[0], (now - before) / 0.001, 1e-9) << "the tool's damper goes as the reference goes";
    before = now;
  }
  EXPECT_NEAR(before, 0.005 + 0.1 * 0.02, 1e-12);
  EXPECT_EQ(end.state().k[0], 400);
  EXPECT_NEAR(end.state().led[0], 0.02, 1e-12) << "others are led by the hand's velocity, without encoder steps";

  // The hand is nearly at rest: the prediction is now less far ahead, and the reference follows it faster.
  in.rx.v[0] = 1e-9;
  EXPECT_NEAR(end.move(in).ref[0], before - 0.15 * 0.001, 1e-9);
}

// The predicted position at the time when the sample reaches the others: further ahead by a part of the hand's own age.
TEST(PredictedHand, ExtrapolatesFurtherForTheOtherSeats) {
  PredictedHand end(one_axis());
  end.engage({}, 0.1);
  EndInput in = hears(0, 1, 0.1);
  in.rx.a[0] = 0.3;
  end.move(in);
  EXPECT_NEAR(end.state().led[0], 0.3 * (1.4 * 0.1 + Prediction::kFilterDelay), 1e-12);
}

TEST(PredictedHand, PullsNoHarderThanAnyMotor) {
  PredictedHand end(one_axis());
  end.engage({}, 0);
  for (int i = 0; i < 500; ++i) end.move(hears(0.05, 1));
  EXPECT_DOUBLE_EQ(end.state().ref[0], 3.3 / 400);
  AxisArray away{};
  away[0] = -0.01;
  end.clamp_reference(away);
  EXPECT_DOUBLE_EQ(end.state().ref[0], -0.01 + 3.3 / 400);
}

TEST(PredictedHand, IgnoresNonFiniteNumbers) {
  PredictedHand end(one_axis());
  end.engage({}, 0);
  for (int i = 0; i < 100; ++i) end.move(hears(0.002, 1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EndInput in = hears(nan, 1);
  in.rx.v[0] = in.rx.a[0] = nan;
  EXPECT_DOUBLE_EQ(end.move(in).ref[0], 0.002);
  EXPECT_EQ(end.state().rate[0], 0);
}

}  // namespace
}  // namespace tandem::control
