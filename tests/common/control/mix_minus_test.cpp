#include "common/control/mix_minus.h"

#include <gtest/gtest.h>

namespace tandem::control {
namespace {

/// Three masters on one tool at 30 mm, which moves at 0.3 m/s.
EscHub hub_with(const MasterArray& alpha) {
  EscHub hub({.axes = 1, .masters = 3, .tools = 1});
  hub.set_authority(0, alpha, false);
  hub.set_tool(0, {.x = {0.03}, .v = {0.3}});
  return hub;
}

struct Target {
  AxisArray x{1}, v{1};
};

TEST(MixMinus, IsTheWeightedMeanOfTheOtherHands) {
  const EscHub hub = hub_with({0.5, 0.3, 0.2});
  Target out;
  MixMinus mix(hub, 0, 0, out.x, out.v);
  ASSERT_TRUE(mix.led());
  EXPECT_TRUE(mix.shares());
  EXPECT_EQ(mix.part(0), 0) << "no echo of its own motion";
  EXPECT_DOUBLE_EQ(mix.part(1), 0.6);
  PortSample hand;
  hand.x[0] = 0.01;
  hand.v[0] = 0.1;
  mix.add_measured(mix.part(1), hand);
  hand.x[0] = 0.02;
  hand.v[0] = -0.1;
  mix.add_measured(mix.part(2), hand);
  EXPECT_DOUBLE_EQ(out.x[0], 0.6 * 0.01 + 0.4 * 0.02);
  EXPECT_DOUBLE_EQ(out.v[0], 0.6 * 0.1 - 0.4 * 0.1);
}

TEST(MixMinus, IsTheToolItselfWhereNoOtherHandLeads) {
  const EscHub hub = hub_with({1, 0, 0});
  Target out;
  const MixMinus mix(hub, 0, 0, out.x, out.v);
  EXPECT_FALSE(mix.led());
  EXPECT_EQ(out.x[0], 0.03);
  EXPECT_EQ(out.v[0], 0.3);
}

TEST(MixMinus, PredictsTheLeaderForAHandThatOnlyFollows) {
  const EscHub hub = hub_with({1, 0, 0});
  LeadingHand steady;
  PortSample still;
  still.x[0] = 0.02;
  for (int i = 0; i < 2000; ++i) steady.step(true, still, 1, 0.1);
  EndState end;
  end.ref[0] = 0.01;
  end.led[0] = 0.2;
  for (const double share : {0.0, 0.5, 1.0}) {
    for (const bool moves : {true, false}) {
      Target out;
      MixMinus mix(hub, 1, 0, out.x, out.v);
      EXPECT_FALSE(mix.shares());
      mix.add_predicted(mix.part(0), end, steady, share, moves);
      EXPECT_NEAR(out.x[0], 0.01 + share * 0.01, 1e-9);
      EXPECT_NEAR(out.v[0], moves ? (1 - share) * 0.2 : 0, 1e-9);
    }
  }
}

TEST(MixMinus, PutsOneSpringInPlaceOfTwo) {
  const EscHub hub = hub_with({0.25, 0.75, 0});
  Target out;
  MixMinus mix(hub, 0, 0, out.x, out.v);
  PortSample hand;
  hand.x[0] = 0.01;
  mix.add_measured(mix.part(1), hand);
  mix.add_slave(0.25, {0.05}, {0.4});
  EXPECT_DOUBLE_EQ(out.x[0], (0.75 * 0.01 + 0.25 * 0.05) / 1.0);
  EXPECT_DOUBLE_EQ(out.v[0], 0.25 * 0.4);
}

TEST(MixMinus, LimitsTheSlavesSpringByBothDelays) {
  GainSchedule hand, slave({.k = 500});
  EXPECT_DOUBLE_EQ(MixMinus::slave_share(1, hand, slave, 5, 400), 1) << "at most the hand's own spring";
  EXPECT_DOUBLE_EQ(MixMinus::slave_share(1, hand, slave, 5, 1000), 0.5);
  hand.settle(0.03);
  EXPECT_DOUBLE_EQ(MixMinus::slave_share(0.5, hand, slave, 5, 400), 0.5 * 5 / 0.03 / 400);
  slave.settle(0.02);
  EXPECT_DOUBLE_EQ(MixMinus::slave_share(1, hand, slave, 5, 400), 100.0 / 400);
}

}  // namespace
}  // namespace tandem::control
