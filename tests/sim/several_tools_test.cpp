// Law `replica`: one hand on several tools. Each tool has a copy at the client and its own channel end, so that tools
// may be at any positions. Virtual time; the devices are simulated Touches.
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::delayed;
using test::SessionDriver;
using test::shipped;
using test::with;

constexpr double kMm = 1e-3;

/// The hand of seat 0 follows two tools with these shares. Each of two other hands leads one tool, to `left` and
/// `right` until 3 s.
SceneSpec two_tools(double weight_left, double left, double right) {
  SceneSpec scene = shipped("two_by_two");
  scene.seats.push_back(scene.seats[1]);
  scene.seats[2].name = "second";
  scene.follow = {};
  scene.follow[0] = {weight_left, 1 - weight_left};
  scene.follow[1][0] = scene.follow[2][1] = 1;
  scene.authority[0].alpha = {0, 1, 0};
  scene.authority[1].alpha = {0, 0, 1};
  const auto to = [](SeatSpec& seat, double x) {
    seat.device.friction = 0;
    seat.hand.trajectory = {};
    seat.hand.trajectory.kind = Trajectory::Kind::kWaypoints;
    seat.hand.trajectory.waypoints = {{1, {0, 0, 0}}, {3, {x, 0, 0}}};
  };
  to(scene.seats[0], 0);
  to(scene.seats[1], left);
  to(scene.seats[2], right);
  scene.duration = 20;
  scene.phases = {{"all", 0, 20, false}};
  return scene;
}
void relax(SeatSpec& seat) {
  seat.hand = {};
  seat.hand.model = HandModel::kRelaxed;
  seat.hand.b = 2;
  seat.hand.m = 0.1;
}
netsim::SimulationConfig over(SceneSpec scene, double delay_ms) {
  netsim::SimulationConfig setup = with(std::move(scene));
  setup.network = netsim::link_from(delayed(delay_ms));
  return setup;
}

// 25 % of a tool at -20 mm and 75 % of one at 20 mm pull to 10 mm. One tool alone would pull with more than a motor's
// force.
TEST(SeveralTools, ARelaxedHandGoesToTheirWeightedMean) {
  for (const double delay : {0.0, 100.0}) {
    SceneSpec scene = two_tools(0.25, -20 * kMm, 20 * kMm);
    relax(scene.seats[0]);
    SessionDriver life{over(std::move(scene), delay)};
    life.until(12s);
    EXPECT_NEAR(life.simulation->device(0).ground_truth().x[0], 10 * kMm, 0.5 * kMm) << delay << " ms";
    EXPECT_NEAR(life.simulation->session().tool(0).x(0), -20 * kMm, 0.5 * kMm) << "a follower moves no tool";
    EXPECT_NEAR(life.simulation->session().tool(1).x(0), 20 * kMm, 0.5 * kMm);
    life.expect_nothing_broken();
  }
}

// A hand leads both tools, one of them against bone at 5 mm. It feels half of that bone at every delay, and the free
// tool follows the hand.
TEST(SeveralTools, RenderTheSurfaceOfOneToolByItsCouplingWeight) {
  for (const double delay : {0.0, 100.0}) {
    SceneSpec scene = two_tools(0.5, 0, 0);
    scene.authority[0].alpha = scene.authority[1].alpha = {1, 0, 0};
    scene.seats[0].hand.trajectory.waypoints = {{1, {0, 0, 0}}, {3, {12 * kMm, 0, 0}}};
    scene.tools[0].environment.wall = WallSpec{.axis = 0, .at = 5 * kMm, .k = 20000, .b = 5, .from_below = true};
    SessionDriver life{over(std::move(scene), delay)};
    life.until(10s);
    const double place = life.simulation->device(0).ground_truth().x[0],
                 force = life.simulation->device(0).state().f_out[0];
    const double k_c = life.simulation->seat(0)->setup().coupling.k_c;
    ASSERT_GT(place, 8 * kMm);
    EXPECT_NEAR(-force / (place - 5 * kMm), 0.5 * k_c * 20000 / (k_c + 20000), 4) << delay << " ms";
    EXPECT_NEAR(life.simulation->session().tool(0).x(0), 5 * kMm, 0.2 * kMm);
    EXPECT_NEAR(life.simulation->session().tool(1).x(0), place, 0.3 * kMm);
    life.expect_nothing_broken();
  }
}

// Tools 80 mm apart, and authority over both that changes 40 times a second. A hand whose spring rested about the mean
// of both received 0.9 N in one tick.
TEST(SeveralTools, AThousandChangesOfAuthorityAreNotFelt) {
  SceneSpec scene = two_tools(0.5, -40 * kMm, 40 * kMm);
  scene.duration = 30;
  scene.phases = {{"all", 0, 30, false}};
  scene.timeline.clear();
  RandomStream random{7};
  for (int i = 0; i < 1000; ++i)
    for (const std::size_t tool : {std::size_t{0}, std::size_t{1}}) {
      TimedAuthority event;
      event.at = 4 + 0.025 * i;
      event.row.tool = tool;
      event.row.alpha[0] = 0.5 * random.uniform();
      event.row.alpha[1 + tool] = 1 - event.row.alpha[0];
      scene.timeline.push_back(event);
    }
  SessionDriver life{with(std::move(scene))};
  life.until(4s);
  life.forget_steps();
  const std::uint32_t first = life.simulation->session().authority().version();
  double apart = 1;
  while (life.at() < 29s && life.step())
    apart = std::min(apart, life.simulation->session().tool(1).x(0) - life.simulation->session().tool(0).x(0));
  EXPECT_GE(life.simulation->session().authority().version() - first, 1900u);
  EXPECT_GT(apart, 40 * kMm);
  for (const double step : life.steps) EXPECT_LE(step, 0.2) << "[N] per ms";
  life.expect_nothing_broken();
}

// The leader of one tool leaves and returns. Meanwhile the tool is braked (HELD) and all hands on it are disengaged.
// Otherwise the springs hold 91 N, which would act at once.
TEST(SeveralTools, LeaveTheBrakedStateWithoutAForceStep) {
  SceneSpec scene = two_tools(0.5, -40 * kMm, 40 * kMm);
  SessionDriver life{
      with(std::move(scene), {{.kind = test::Fault::Kind::kRestart, .seat = "second", .at = 5s, .length = 2s}})};
  life.until(5s);
  ASSERT_TRUE(life.active(0));
  life.forget_steps();
  bool held = false;
  while (life.at() < 12s && life.step()) held |= life.simulation->session().tool(1).authority.held();
  EXPECT_TRUE(held);
  EXPECT_TRUE(life.active(0)) << "and is back";
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(life.steps[i], 0.2) << "[N] per ms, seat " << i;
  life.expect_nothing_broken();
}

// Authority over a tool that a hand does not follow: the hand moves the tool and feels nothing of it. The tool moves
// towards it with at most a motor's force.
TEST(SeveralTools, LimitThePullOfALeaderThatDoesNotFollowTheTool) {
  SceneSpec scene = two_tools(1, 0, 40 * kMm);
  scene.follow[0] = {1, 0};
  TimedAuthority event;
  event.at = 5;
  event.row.tool = 1;
  event.row.alpha[0] = 1;
  scene.timeline = {event};
  SessionDriver life{with(std::move(scene))};
  double most = 0, before = 0, speed = 0;
  while (life.at() < 12s && life.step()) {
    const server::Session& session = life.simulation->session();
    const double x = session.tool(1).x(0), pull = 400 * std::abs(session.seat(0).end(1).state().ref[0] - x);
    if (session.tool(1).authority.alpha(0) > 0) most = std::max(most, pull);
    if (life.at() > 4s) speed = std::max(speed, std::abs(x - before) / 1e-3);
    before = x;
  }
  EXPECT_NEAR(life.simulation->session().tool(1).x(0), life.simulation->device(0).ground_truth().x[0], 1 * kMm)
      << "it comes to the hand, 40 mm away";
  EXPECT_LE(most, 3.3 * 400 / 370 + 1e-6);
  EXPECT_LE(speed, 1) << "[m/s]";
  life.expect_nothing_broken();
}

}  // namespace
}  // namespace tandem
