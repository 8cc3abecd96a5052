#include "common/control/channel_tdpa.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tandem::control {
namespace {

constexpr double kK = 1500;

ChannelParams plain(Side side, double e0) {
  ChannelParams p;
  p.side = side;
  p.dof = 1;
  p.e0 = e0;
  p.schedule.k = p.schedule.k_min = kK;
  p.v_app = 0;
  p.margin_max = 10;
  return p;
}

EndInput force(double f, double x) {
  EndInput in;
  in.rx.f[0] = f;
  in.x[0] = x;
  return in;
}

TEST(TdpaChannel, FeelsTheReactionOfTheReceivedForceAndPaysItsWork) {
  TdpaForceEnd end(plain(Side::kClient, 1));
  end.engage({}, 0);
  const EndState& s = end.move(force(-1, 0));  // the tool is pulled with -1 N, so the hand with 1 N
  EXPECT_NEAR(s.k[0] * (s.ref[0] - 0), 1, 1e-12);
  EXPECT_EQ(s.paid[0], 0);
  end.move(force(-1, 1e-4));  // the hand moved by 0.1 mm: 1500 (2/3 mm - 0.1 mm) 0.1 mm = 85 uJ
  EXPECT_NEAR(s.paid[0], 85e-6, 1e-12);
  EXPECT_NEAR(s.k[0] * (s.ref[0] - 2e-4), 1, 1e-12) << "1 N at the end of a step like the last";
  end.move(force(-1, 0));  // pushed back by 0.1 mm: the channel takes energy, which the server may spend
  EXPECT_GT(s.absorbed[0], 0);
  EXPECT_EQ(s.paid[0], 0);
}

TEST(TdpaChannel, TheWorkOfAStepNeverExceedsTheAccountWhateverTheHandDoes) {
  for (const double dx : {1e-6, 1e-5, 1e-4, 2.58e-4, 5e-4, 1e-3, 0.1}) {
    TdpaForceEnd end(plain(Side::kClient, 1e-4));
    end.engage({}, 0);
    const EndState& s = end.move(force(-3.3, 0));  // 3.3 N wanted; 2 sqrt(k E) = 0.775 N allowed
    EXPECT_NEAR(s.k[0] * s.ref[0], 2 * std::sqrt(kK * 1e-4), 1e-5);
    end.move(force(-3.3, dx));
    EXPECT_TRUE(end.ledger(0).holds()) << dx;
    EXPECT_LE(s.paid[0], 1e-4 + 1e-9) << dx;
  }
}

TEST(TdpaChannel, DampsWhileItsAccountIsShort) {
  TdpaForceEnd end(plain(Side::kClient, 0.01));
  end.engage({}, 0);
  end.move(force(-3, 0));
  double x = 0;
  for (int tick = 0; tick < 100; ++tick) end.move(force(-3, x += 1e-4));  // 3 N along 10 mm: 30 mJ, 10 mJ are there
  EXPECT_EQ(end.state().b[0], TdpaForceEnd::kDampingMax);
  EXPECT_TRUE(end.ledger(0).holds());
  EXPECT_GT(end.refused(), 0);
}

TEST(TdpaChannel, TheToolMakesTheReceivedMotionAsFarAsItIsPaidFor) {
  TdpaPositionEnd end(plain(Side::kServer, 0.012));
  end.engage({}, 0);
  EndInput in;
  in.rx.x[0] = 0.5;  // where the hand is when the seat engages: nothing moves
  EXPECT_EQ(end.move(in).ref[0], 0);
  in.rx.x[0] = 0.501;
  in.rx.v[0] = 1;
  EXPECT_NEAR(end.move(in).ref[0], 0.001, 1e-12);  // 1/2 1500 0.001^2 = 0.75 mJ
  in.rx.x[0] = 0.506;
  in.rx.v[0] = 5;
  end.move(in);  // 27 mJ wanted, 12 mJ in all: 4 mm
  EXPECT_NEAR(end.state().ref[0], 0.004, 1e-6);
  EXPECT_TRUE(end.ledger(0).holds());
}

TEST(TdpaChannel, LostPositionComesBackAtTheApproachSpeedWhenItIsPaidFor) {
  ChannelParams p = plain(Side::kServer, 0.012);
  p.v_app = 0.1;
  TdpaPositionEnd end(p);
  end.engage({}, 0);
  EndInput in;
  end.move(in);
  in.rx.x[0] = 0.01;  // 75 mJ wanted, 12 mJ there
  in.rx.v[0] = 10;
  end.move(in);
  const double lost = 0.01 - end.state().ref[0];
  ASSERT_NEAR(lost, 0.006, 1e-6);
  in.rx.v[0] = 0;
  in.rx.e_in[0] = 1'000'000'000;
  for (int tick = 1; tick <= 30; ++tick) {
    end.move(in);
    ASSERT_NEAR(end.state().ref[0], 0.004 + 1e-4 * tick, 1e-6);
  }
}

}  // namespace
}  // namespace tandem::control
