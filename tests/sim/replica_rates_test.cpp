// Law `replica` at every tick rate, in virtual time: the stiffness that a device renders, the force on a resting hand,
// the distance of tool and leader. Live twins: tests/io/tick_rates_io_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/stiffness_limit.h"
#include "netsim/system/session_notes.h"
#include "proto/text/scene_text.h"
#include "tests/sim/replica_scene.h"
#include "tests/sim/session_driver.h"
#include "tests/support/press_scene.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::delayed;
using test::PressScene;
using test::SessionDriver;
using test::with;

SceneSpec parsed(const PressScene& press) {
  auto scene = parse_scene(press.text(), "press.textproto");
  if (!scene) throw std::runtime_error(to_text(scene.error()));
  return *scene;
}

double place_x(const SessionDriver& life, std::size_t seat) {
  return life.simulation->device(seat).ground_truth().x[0];
}

class ReplicaTickRates : public testing::TestWithParam<double> {};

// Device spring and wall in series, and the hand's own spring. Neither the rate nor the network delay changes the force
// on a resting hand, and the tool is at the position that this force causes.
TEST_P(ReplicaTickRates, GiveTheForceOfTheSpringsInSeries) {
  PressScene press;
  press.tick_hz = GetParam();
  press.replica = true;
  for (const double delay : {0.0, 40.0}) {
    netsim::SimulationConfig setup = with(parsed(press));
    setup.network = netsim::link_from(delayed(delay));
    SessionDriver life{std::move(setup)};
    double force = 0, tool = 0;
    std::size_t n = 0;
    while (life.step()) {
      if (!press.rests(life.simulation->session().clock().time())) continue;
      ++n;
      force -= life.simulation->device(0).state().f_out[0];
      tool += life.simulation->session().tool(0).x(0);
    }
    ASSERT_GT(n, 10u);
    force /= static_cast<double>(n), tool /= static_cast<double>(n);
    EXPECT_NEAR(force / press.force(), 1, 0.01) << delay << " ms";
    EXPECT_NEAR(tool, press.force() / PressScene::kWall, 5e-6) << delay << " ms";
    EXPECT_EQ(life.simulation->device(0).counts().expired, 0u) << "commands that died of age between two ticks";
    life.expect_nothing_broken();
  }
}

/// Returns leader minus tool in free motion, 50 mm at 0.5 Hz over 20 ms, after the start of the motion [m RMS].
double behind(double tick_hz) {
  SceneSpec scene = test::shipped("free_motion");
  scene.tick_hz = tick_hz;
  scene.coupling.k_c = 360;  // the same springs at every rate, also where a Touch renders less
  for (SeatSpec& seat : scene.seats) {
    seat.hand.deviations.clear();
    seat.device.damping = 2;
  }
  scene.timeline.clear();
  scene.seats[0].hand.until = std::numeric_limits<double>::infinity();
  scene.seats[1].hand = {};
  scene.seats[1].hand.model = HandModel::kRelaxed;
  scene.seats[1].hand.b = 2;
  scene.seats[1].hand.m = 0.1;
  scene.phases = {{"all", 0, 7, false}};
  scene.duration = 7;
  netsim::SimulationConfig setup = with(std::move(scene));
  setup.network = netsim::link_from(delayed(20));
  SessionDriver life{std::move(setup)};
  life.until(3s);
  double square = 0;
  int n = 0;
  for (; life.at() < 6500ms; ++n) {
    life.step();
    const server::Tool& tool = life.simulation->session().tool(0);
    square += (life.simulation->device(0).ground_truth().x - hal::Vec3{tool.x(0), tool.x(1), tool.x(2)}).squaredNorm();
  }
  life.expect_nothing_broken();
  return std::sqrt(square / n);
}

// Poles, slews and predictions are in seconds, so that the rate hardly matters: 0.08 mm at 500 Hz to 0.12 mm at 4 kHz.
// The transport lag is 3.1 mm.
TEST_P(ReplicaTickRates, TheToolFollowsItsLeader) {
  const double at_this = behind(GetParam());
  std::printf("%5.0f Hz: leader-tool %.3f mm\n", GetParam(), 1e3 * at_this);
  EXPECT_NEAR(at_this, behind(1000), 0.05e-3);
  EXPECT_LT(at_this, 0.15e-3);
}

// A Touch renders 0.93 b / (T/2), limited by the stiffness of the scene. Both ends use this value.
TEST_P(ReplicaTickRates, TheStiffnessIsWhatTheDeviceRenders) {
  SceneSpec scene = test::shipped("contact");
  scene.tick_hz = GetParam();
  const double renders = std::min(400.0, 0.93 * 0.2 / (0.5 / GetParam()));
  SessionDriver life{with(scene)};
  life.until(1s);
  for (const std::size_t i : {0u, 1u}) {
    ASSERT_NE(life.simulation->seat(i), nullptr);
    EXPECT_NEAR(life.simulation->seat(i)->setup().coupling.k_c, renders, 1e-9);
    EXPECT_NEAR(life.simulation->session().seat(i).end().state().k[0], renders, 1e-9);
  }
  const auto notes = netsim::session_notes({.scene = scene}, {1s, 20s});
  EXPECT_EQ(notes.size(), renders < 0.9 * 400 ? 2u : 0u);
  if (!notes.empty()) {
    EXPECT_NE(notes[0].find("instead of the scene's 400"), std::string::npos) << notes[0];
    EXPECT_NE(notes[0].find("damping b 0.2 N s/m, tick T"), std::string::npos) << notes[0];
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReplicaTickRates, testing::Values(100, 200, 500, 1000, 2000, 4000),
                         [](const auto& rate) { return std::to_string(static_cast<int>(rate.param)) + "Hz"; });

// Two devices, two springs: each hand feels its own, and both forces together press the tool.
TEST(ReplicaStiffness, EachSeatHasTheSpringOfItsOwnDevice) {
  SceneSpec scene = test::pressing(20000, 0.003, 0.007);
  scene.seats[0].device.damping = 0.1;
  SessionDriver life{with(scene)};
  life.until(4200ms);
  const double lightly = life.simulation->device(0).state().f_out[0], there = place_x(life, 0);
  life.until(8s);
  const double felt = -(life.simulation->device(0).state().f_out[0] - lightly) / (place_x(life, 0) - there);
  const double k = kStiffnessShare * stiffness_limit(0.1, 0, 1e-3);  // 186 N/m
  EXPECT_NEAR(felt, 1 / (1 / k + 1 / 20000.0), 0.03 * k);
  EXPECT_NEAR(life.simulation->seat(1)->setup().coupling.k_c, 2 * k, 1e-9);
  EXPECT_NEAR(life.simulation->session().tool(0).body()->surface_force()[0],
              life.simulation->device(0).state().f_out[0], 0.05)
      << "the tool presses as hard as the hand feels";
  life.expect_nothing_broken();
}

}  // namespace
}  // namespace tandem
