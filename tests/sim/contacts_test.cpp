// Surfaces from an engine beside the server, in whole sessions of law `replica`. Hands feel them correctly at every
// delay, without a step of force and without unpaid energy.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim/replica_scene.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::delayed;
using test::pressing;
using test::SessionDriver;
using test::with;

/// A plane normal to x whose position is a function of session time [s -> m]. While that is not finite, there is no
/// plane.
class MovingPlane final : public server::ContactSource {
 public:
  using Place = std::function<double(double)>;
  MovingPlane(Place place, float k, float mu = 0) : place_(std::move(place)), k_(k), mu_(mu) {}
  void find_contacts(const server::ToolView& tool, LocalContactList& out) noexcept override {
    const double at = place_(tool.time);
    if (!std::isfinite(at)) return;
    LocalContact plane{.id = 7, .k = k_, .b = 5, .mu = mu_};
    plane.point[0] = static_cast<float>(at);
    plane.normal[0] = -1;
    out.add(plane);
  }

 private:
  Place place_;
  float k_, mu_;
};

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
/// Returns the stiffness of the hand's spring, 0.93 b / (T/2) = 372 N/m, in series with that of the plane [N/m].
double series(double k) { return 1 / (1 / 372.0 + 1 / k); }

/// Returns one hand alone that intends to be 7 mm beyond x = 0 from 2 s on; the scene has no surface of its own.
netsim::SimulationConfig held(double delay_ms, MovingPlane::Place place, float k = 20000, float mu = 0) {
  SceneSpec scene = pressing(20000, 0.007, 0.007);
  scene.tools[0].environment = {};
  scene.seats[0].device.encoder = 0;  // encoder steps are not covered here
  netsim::SimulationConfig setup = with(std::move(scene));
  setup.network = netsim::link_from(delayed(delay_ms));
  setup.contact_source = [=](std::size_t) { return std::make_unique<MovingPlane>(place, k, mu); };
  return setup;
}
void until_session(SessionDriver& life, double t) {
  while (life.simulation->session().clock().time() < t && life.step()) {
  }
}
double force_x(const SessionDriver& life) { return life.simulation->device(0).state().f_out[0]; }
double hand_x(const SessionDriver& life) { return life.simulation->device(0).ground_truth().x[0]; }

TEST(Contacts, RenderSpringsInSeriesAtEveryDelay) {
  for (const double delay : {0.0, 50.0, 200.0, 500.0})
    for (const float k : {300.0F, 20000.0F}) {
      SessionDriver life{held(delay, [](double) { return 0.0; }, k)};
      until_session(life, 7);
      double felt = 0, place = 0, tool = 0, apart = 0;
      constexpr int kTicks = 500;
      for (int n = 0; n < kTicks; ++n) {
        life.step();
        felt += force_x(life) / kTicks;
        place += hand_x(life) / kTicks;
        tool += life.simulation->session().tool(0).body()->surface_force()[0] / kTicks;
        apart +=
            std::abs(life.simulation->seat(0)->coupling().tool_copy()->x(0) - life.simulation->session().tool(0).x(0)) /
            kTicks;
      }
      EXPECT_NEAR(felt, -series(k) * place, 0.03) << delay << " ms, " << k << " N/m";  // a step of an encoder is 0.02 N
      EXPECT_NEAR(tool, felt, 0.05) << delay << " ms, " << k << " N/m";
      EXPECT_LT(apart, 1e-4);
      life.expect_nothing_broken();
    }
}

/// The plane appears inside the hand's path, jumps, and disappears while the hand is held.
TEST(Contacts, AppearMoveAndDisappearWithoutAForceStep) {
  for (const double delay : {0.0, 100.0}) {
    SessionDriver life{held(delay, [](double t) {
      return t < 5 ? kNowhere : t < 6 ? 0.0 : t < 7 ? 0.004 : t < 8 ? 0.001 : kNowhere;
    })};
    until_session(life, 4.95);
    EXPECT_NEAR(force_x(life), 0, 0.05);
    life.forget_steps();
    until_session(life, 5.95);
    EXPECT_NEAR(force_x(life), -series(20000) * hand_x(life), 0.1);
    until_session(life, 6.95);
    EXPECT_NEAR(force_x(life), -series(20000) * (hand_x(life) - 0.004), 0.1);
    until_session(life, 7.95);
    EXPECT_NEAR(force_x(life), -series(20000) * (hand_x(life) - 0.001), 0.1);
    until_session(life, 8.8);
    EXPECT_NEAR(force_x(life), 0, 0.05);
    EXPECT_LT(life.steps[0], 0.1) << "0.04 N per ms at v_app, and steps of the encoder";
    EXPECT_EQ(life.simulation->session().tool(0).contacts_refused(), 0u);
    life.expect_nothing_broken();
  }
}

/// A plane that oscillates by 6 mm drives a hand that yields. The ledger pays all of that energy.
TEST(Contacts, StayWithinTheLedgerWhileTheyMove) {
  for (const double delay : {0.0, 100.0}) {
    netsim::SimulationConfig setup = held(delay, [](double t) { return 0.003 * std::sin(2 * t); });
    setup.scene.seats[0].hand.k = 100;
    setup.scene.seats[0].hand.b = 3;
    SessionDriver life{std::move(setup)};
    double least = 0, most = -10;
    life.until(5s);
    while (life.at() < 10s) {
      life.step();
      least = std::min(least, force_x(life));
      most = std::max(most, force_x(life));
    }
    EXPECT_LT(least, most - 0.2) << "it is felt";
    EXPECT_LT(life.steps[0], 0.15);
    life.expect_nothing_broken();
  }
}

/// A gap of 60 ms changes nothing. After 150 ms without data the plane retreats, and returns later.
TEST(Contacts, PersistThroughAShortGapAndRetreatInALongOne) {
  for (const double gap_ms : {60.0, 200.0}) {
    netsim::SimulationConfig setup = held(5, [](double) { return 0.0; });
    netsim::SimpleNetwork net = delayed(5);
    netsim::OutageSpec outage;
    outage.start = 7s;
    outage.length = from_seconds(1e-3 * gap_ms);
    net.outages.push_back(outage);
    setup.network = netsim::link_from(net);
    SessionDriver life{std::move(setup)};
    life.until(6900ms);
    const double before = force_x(life);
    life.forget_steps();
    double weakest = before;
    while (life.at() < 7500ms) {
      life.step();
      weakest = std::max(weakest, force_x(life));
    }
    EXPECT_LT(before, -1.5);
    if (gap_ms < 100) {
      EXPECT_NEAR(weakest, before, 0.1);
    } else {
      EXPECT_GT(weakest, before + 0.5);
    }
    EXPECT_NEAR(force_x(life), before, 0.1);
    EXPECT_LT(life.steps[0], 0.1);
    life.expect_nothing_broken();
  }
}

/// The server validates the contacts of an engine before it uses them.
TEST(Contacts, AreRejectedByTheServerWhenInvalid) {
  class Broken final : public server::ContactSource {
    void find_contacts(const server::ToolView&, LocalContactList& out) noexcept override {
      LocalContact c{.id = 1, .k = 1000};
      out.add(c);  // no normal
      c.normal = {-1, 0, 0};
      c.k = std::numeric_limits<float>::quiet_NaN();
      out.add(c);
      c.k = 1000;
      out.add(c);
      out.add(c);  // twice
      out.size = 1000;
    }
  };
  netsim::SimulationConfig setup = held(5, {});
  setup.contact_source = [](std::size_t) { return std::make_unique<Broken>(); };
  SessionDriver life{std::move(setup)};
  life.until(4s);
  EXPECT_EQ(life.simulation->session().tool(0).contacts().size, 1u);
  EXPECT_GT(life.simulation->session().tool(0).contacts_refused(), 3000u);
  EXPECT_NEAR(force_x(life), -series(1000) * hand_x(life), 0.1);
  life.expect_nothing_broken();
}

TEST(Contacts, NeedALawAndAToolThatSupportSurfaces) {
  SceneSpec scene = test::shipped("seed_contact");
  std::vector<std::unique_ptr<hal::SteppedDevice>> none(scene.tools.size());
  server::Session session(scene, std::move(none), {1, 1, 1, 1, 1, 1, 1});
  EXPECT_FALSE(session.set_contact_source(0, std::make_unique<MovingPlane>([](double) { return 0.0; }, 100)));
  scene = test::shipped("contact");
  std::vector<std::unique_ptr<hal::SteppedDevice>> more(scene.tools.size());
  server::Session other(scene, std::move(more), {1, 1, 1, 1, 1, 1, 1});
  EXPECT_TRUE(other.set_contact_source(0, std::make_unique<MovingPlane>([](double) { return 0.0; }, 100)));
  EXPECT_FALSE(other.set_contact_source(1, nullptr));
}

/// A rough plane drags a sliding hand with mu times the normal force.
TEST(Contacts, DragASlidingHandByTheirFriction) {
  netsim::SimulationConfig setup = held(50, [](double) { return 0.0; }, 5000, 0.5F);
  setup.scene.seats[0].device.friction = 0;
  setup.scene.seats[0].hand.trajectory.waypoints = {
      {0.5, {-0.02, 0, 0}}, {2, {0.006, -0.04, 0}}, {4, {0.006, -0.04, 0}}, {8, {0.006, 0.04, 0}}};
  SessionDriver life{std::move(setup)};
  life.until(5500ms);
  double across = 0, along = 0;
  for (int i = 0; i < 1000; ++i) {
    life.step();
    along += life.simulation->device(0).state().f_out[0];
    across += life.simulation->device(0).state().f_out[1];
  }
  EXPECT_LT(along, -1000.0);
  EXPECT_NEAR(across / along, 0.5, 0.05) << "against the motion, along +y";
  life.expect_nothing_broken();
}

}  // namespace
}  // namespace tandem
