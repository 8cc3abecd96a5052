// A leader whose tool is driven by a SLAVE seat, law `replica`. The server estimates the surface that the slave
// touches, and the client renders it.
#include "server/session/estimated_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/session_driver.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::delayed;
using test::SessionDriver;
using test::with;

/// Returns one hand that intends to be `deep` along x from 4 s on and 4 mm deeper from 6.5 s on, and retreats at 8.5 s.
/// The slave's surface is at 0.
netsim::SimulationConfig remote(double k_surface, double delay_ms, ContactsMode contacts, double deep = 0.004) {
  SceneSpec scene = test::shipped("contact_remote");
  scene.channel.law = LawKind::kReplica;
  scene.channel.e0 = ChannelSpec{}.e0;
  scene.tools[0].contacts = contacts;
  scene.seats[0].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}},        {2, {0, 0, 0}},
                                              {4, {deep, 0, 0}},           {6, {deep, 0, 0}},
                                              {6.5, {deep + 0.004, 0, 0}}, {8.5, {deep + 0.004, 0, 0}},
                                              {9.5, {-0.02, 0, 0}}};
  scene.seats[1].hand = {};
  scene.seats[1].hand.model = HandModel::kRelaxed;
  scene.seats[1].hand.b = 2;
  scene.seats[1].hand.m = 0.1;
  for (EnvironmentSpec* environment : {&scene.seats[2].environment, &scene.tools[0].environment})
    environment->wall = WallSpec{.axis = 0, .at = 0, .k = k_surface, .b = 5, .from_below = true};
  scene.timeline.clear();
  scene.phases = {{"all", 0, 13, false}};
  scene.duration = 13;
  netsim::SimulationConfig setup = with(std::move(scene));
  setup.network = netsim::link_from(delayed(delay_ms));
  return setup;
}
void until_session(SessionDriver& life, double t) {
  while (life.simulation->session().clock().time() < t && life.step()) {
  }
}

struct Point {
  double force = 0, place = 0, slave = 0;
};
/// Returns means over 300 ms: force on the hand, its position, force of the slave on the surface.
Point mean(SessionDriver& life) {
  Point out;
  int n = 0;
  for (const Duration end = life.at() + 300ms; life.at() < end; ++n) {
    life.step();
    out.force += life.simulation->device(0).state().f_out[0];
    out.place += life.simulation->device(0).ground_truth().x[0];
    out.slave += life.simulation->device(2).state().f_env[0];
  }
  out.force /= n, out.place /= n, out.slave /= n;
  return out;
}
/// Returns force over depth [N/m].
double stiffness(const Point& held) { return -held.force / held.place; }

TEST(EstimatedPlane, RendersTheSlavesContactStiffnessAtEveryDelay) {
  for (const double delay : {0.0, 20.0, 50.0, 100.0})
    for (const double k : {20000.0, 300.0}) {
      SessionDriver life{remote(k, delay, ContactsMode::kEstimated)};
      until_session(life, 8);
      const Point held = mean(life);
      EXPECT_NEAR(stiffness(held), 1 / (1 / 372.0 + 1 / k), 0.1 / (1 / 372.0 + 1 / k))
          << delay << " ms, " << k << " N/m";
      EXPECT_NEAR(held.slave, held.force, 0.3)
          << "the slave presses as hard as the hand feels, but for friction; " << delay << " ms, " << k << " N/m";
      life.expect_nothing_broken();
    }
}

TEST(EstimatedPlane, LeavesTheSpringToTheSlaveWhenDisabled) {
  SessionDriver life{remote(20000, 0, ContactsMode::kNone)};
  until_session(life, 8);
  EXPECT_NEAR(stiffness(mean(life)), 186, 19) << "372 N/m twice in series";
  EXPECT_EQ(life.simulation->session().tool(0).contacts().size, 0u);
  life.expect_nothing_broken();
}

TEST(EstimatedPlane, AppearsAndDisappearsWithoutAForceStep) {
  for (const double delay : {0.0, 20.0, 100.0}) {
    SessionDriver life{remote(20000, delay, ContactsMode::kEstimated, 0.006)};
    life.until(1500ms);
    life.forget_steps();
    bool known = false;
    while (life.simulation->session().clock().time() < 9) {
      life.step();
      known = known || life.simulation->session().tool(0).contacts().size > 0;
    }
    EXPECT_TRUE(known);
    until_session(life, 11.5);
    EXPECT_EQ(life.simulation->session().tool(0).contacts().size, 0u) << "free again";
    EXPECT_LT(std::abs(life.simulation->device(0).state().f_out[0]), 0.1);
    EXPECT_LT(life.steps[0], 0.15) << delay << " ms";
    life.expect_nothing_broken();
  }
}

/// From one tick to the next the estimated spring to the slave changes little.
TEST(EstimatedPlane, ChangesItsConfidenceGradually) {
  server::EstimatedPlane plane(3);
  server::ToolView view;
  view.slave = view.fresh = true;
  double before = plane.confidence(), least = 1;
  bool named = false;
  for (int i = 0; i < 1500; ++i) {
    const double force = std::clamp(0.004 * (i - 100), 0.0, 2.0);  // comes to rest on 1000 N/m
    view.slave_x[0] = force / 1000;
    view.slave_f[0] = -force;
    LocalContactList out;
    plane.find_contacts(view, out);
    ASSERT_LE(std::abs(plane.confidence() - before), server::EstimatedPlane::kConfidenceRate * view.dt + 1e-12) << i;
    before = plane.confidence();
    least = std::min(least, before);
    named = named || out.size == 1;
  }
  EXPECT_LT(least, 0.9);
  EXPECT_EQ(before, 1);
  EXPECT_TRUE(named);
  view.slave = false;
  LocalContactList out;
  plane.find_contacts(view, out);
  EXPECT_EQ(out.size, 0u) << "a slave that is gone touches nothing";
}

/// Free motion: without contact the hand feels no surface.
TEST(EstimatedPlane, DoesNotDragTheLeaderInFreeMotion) {
  for (const double delay : {0.0, 100.0}) {
    netsim::SimulationConfig setup = remote(300, delay, ContactsMode::kEstimated);
    setup.scene.seats[0].hand.trajectory = {};
    setup.scene.seats[0].hand.trajectory.center = {-0.06, 0, 0};
    setup.scene.seats[0].hand.trajectory.radius = 0.03;
    setup.scene.seats[0].hand.trajectory.plane = 'x';
    SessionDriver life{std::move(setup)};
    life.until(5s);
    double square = 0;
    int n = 0;
    for (; life.at() < 9s; ++n) {
      life.step();
      square += life.simulation->device(0).state().f_out.squaredNorm();
    }
    EXPECT_LT(std::sqrt(square / n), 0.15) << delay << " ms";
    life.expect_nothing_broken();
  }
}

}  // namespace
}  // namespace tandem
