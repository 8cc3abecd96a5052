#include "common/control/channel_pd.h"

#include <gtest/gtest.h>

namespace tandem::control {
namespace {

TEST(PdChannel, FollowsTheReceivedPositionAtTheGainsOfTheDelay) {
  ChannelParams p;
  p.dof = 1;
  p.schedule.k = 1000;
  p.schedule.k_delay = 5;
  PdEnd end(p);
  end.engage({}, 0.02);  // k = 5 N s/m / 20 ms = 250 N/m, B = 1.1 * 250 N/m * 20 ms = 5.5 N s/m
  EndInput in;
  in.age = 0.02 + 0.5 * in.dt;
  in.rx.x[0] = 0.004;
  const EndState& s = end.move(in);
  EXPECT_EQ(s.ref[0], 0.004);
  EXPECT_NEAR(s.k[0], 250, 1e-9);
  EXPECT_NEAR(s.b[0], 5.5, 1e-9);
  EXPECT_NEAR(s.paid[0], 0.5 * 250 * 0.004 * 0.004, 1e-12);  // booked, not limited
}

TEST(PdChannel, HasNoDampingWithoutDelay) {
  ChannelParams p;
  p.dof = 1;
  PdEnd end(p);
  end.engage({}, 0);
  EndInput in;
  in.age = 0.5 * in.dt;
  EXPECT_EQ(end.move(in).b[0], 0);
  EXPECT_EQ(end.state().k[0], p.schedule.k);
}

}  // namespace
}  // namespace tandem::control
