#include "client/seat/motion_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/seat/coupling.h"
#include "common/base/rng.h"
#include "common/setup/channel_factory.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/common/base/counts.h"

namespace tandem::client {
namespace {

TEST(MotionScale, MapsMotionAndForceByTheSameFactor) {
  MotionScale half(0.5, 3);
  half.update({0.02, -0.04, 0}, {0.1, 0, 0});
  EXPECT_EQ(half.q(), (AxisArray{0.01, -0.02, 0}));
  EXPECT_EQ(half.v(), (AxisArray{0.05, 0, 0}));
  EXPECT_EQ(half.effort_at_hand({4, 0, -2}), (AxisArray{2, 0, -1}));
  EXPECT_EQ(half.effort_at_tool({2, 0, -1}), (AxisArray{4, 0, -2}));
  EXPECT_EQ(half.position_at_hand({0.01, -0.02, 0}), (AxisArray{0.02, -0.04, 0}));
}

TEST(MotionScale, ConservesPower) {
  for (std::uint64_t seed = 1, last = test::seeds(100); seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r(seed);
    MotionScale scale(std::exp(r.uniform(std::log(0.1), std::log(4.0))), 3);
    const AxisArray v{r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1)},
        at_tool{r.uniform(-30, 30), r.uniform(-30, 30), r.uniform(-30, 30)};
    scale.update({}, v);
    const AxisArray at_hand = scale.effort_at_hand(at_tool);
    double hand = 0, tool = 0, sum = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      hand += at_hand[a] * v[a];
      tool += at_tool[a] * scale.v()[a];
      sum += std::abs(at_hand[a] * v[a]);
    }
    EXPECT_NEAR(hand, tool, 1e-12 * sum);
  }
}

/// A hand with scale s that holds still 5 mm beyond a wall of 20 kN/m at the tool feels the spring of its device and
/// s^2 times the wall, in series.
TEST(MotionScale, RendersTheSquareOfTheScaleOfAWall) {
  for (const double s : {0.1, 0.5, 1.0, 2.0, 4.0}) {
    SCOPED_TRACE(s);
    auto scene = parse_scene(find_shipped_scene("contact")->text, "contact");
    ASSERT_TRUE(scene);
    scene->seats[0].motion_scale = s;
    const SeatSetup setup = seat_setup(*scene, 0);
    const auto coupling = make_coupling(setup);
    const auto end = setup::make_channel(setup.channel, control::Side::kClient, setup.dof, setup.axis_scale, 3.3,
                                         setup.coupling.k_c, true, std::nullopt, s);
    wire::ToolForce received;
    received.alpha = 1;
    const Coupling::Tool tool{end.get(), &received};
    MotionScale scale(s, 3);
    AxisArray effort{};
    const auto input = [&](double x) {
      scale.update({x}, {});
      return Coupling::Input{.dt = 0.001, .age = 0, .q = scale.q(), .v = scale.v(), .tools = {&tool, 1}};
    };
    coupling->reset(input(0), false);
    for (int tick = 0; tick < 4000; ++tick) {
      effort = scale.effort_at_hand(coupling->step(input(0.005 * std::min(1.0, tick / 1000.0))));
      coupling->set_delivered(scale.effort_at_tool(effort));
    }
    EXPECT_NEAR(effort[0], -0.005 / (1 / setup.coupling.k_c + 1 / (s * s * 20000)), 2e-3);
  }
}

}  // namespace
}  // namespace tandem::client
