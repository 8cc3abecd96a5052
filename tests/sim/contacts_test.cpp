// Surfaces that an engine beside the server tells of, in whole sessions of law `replica`: felt at every delay as they are, with no step of
// force, and no energy that was not paid.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim/life.h"
#include "tests/sim/replica_scene.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::delayed;
using test::Life;
using test::pressing;
using test::with;

/// A plane normal to x whose place is a function of session time. Nothing is told where that is not finite.
class MovingPlane final : public server::ContactSource {
 public:
  using Place = std::function<double(double)>;
  MovingPlane(Place place, float k, float mu = 0) : place_(std::move(place)), k_(k), mu_(mu) {}
  void look(const server::ToolView& tool, LocalContactList& out) noexcept override {
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
/// The spring of the hand, 0.93 b / (T/2) = 372 N/m, in series with that of the plane.
double series(double k) { return 1 / (1 / 372.0 + 1 / k); }

/// One hand alone that wants to be 7 mm beyond x = 0 from 2 s on; no surface of the scene's own.
netsim::WorldSetup held(double delay_ms, MovingPlane::Place place, float k = 20000, float mu = 0) {
  SceneSpec scene = pressing(20000, 0.007, 0.007);
  scene.tools[0].environment = {};
  scene.seats[0].device.encoder = 0;  // what a resting hand's encoder steps do to the tool at the server is not the matter here
  netsim::WorldSetup setup = with(std::move(scene));
  setup.network = netsim::link_from(delayed(delay_ms));
  setup.contact_source = [=](std::size_t) { return std::make_unique<MovingPlane>(place, k, mu); };
  return setup;
}
void until_session(Life& life, double t) {
  while (life.world->session().time() < t && life.step()) {}
}
double force_x(const Life& life) { return life.world->device(0).state().f_out[0]; }
double hand_x(const Life& life) { return life.world->device(0).truth().x[0]; }

TEST(Contacts, AreFeltAtEveryDelayAsThoseOfASceneAre) {
  for (const double delay : {0.0, 50.0, 200.0, 500.0})
    for (const float k : {300.0F, 20000.0F}) {
      Life life{held(delay, [](double) { return 0.0; }, k)};
      until_session(life, 7);
      double felt = 0, place = 0, tool = 0, apart = 0;
      constexpr int kTicks = 500;
      for (int n = 0; n < kTicks; ++n) {
        life.step();
        felt += force_x(life) / kTicks;
        place += hand_x(life) / kTicks;
        tool += life.world->session().tool(0).body()->surface_force()[0] / kTicks;
        apart += std::abs(life.world->seat(0)->coupling().copy()->x(0) - life.world->session().tool(0).x(0)) / kTicks;
      }
      EXPECT_NEAR(felt, -series(k) * place, 0.03) << delay << " ms, " << k << " N/m";  // a step of an encoder is 0.02 N
      EXPECT_NEAR(tool, felt, 0.05) << delay << " ms, " << k << " N/m";
      EXPECT_LT(apart, 1e-4);
      life.expect_nothing_broken();
    }
}

/// Appears inside the hand's way, leaps, and goes; the hand is held all the time.
TEST(Contacts, ComeMoveAndGoWithoutAStep) {
  for (const double delay : {0.0, 100.0}) {
    Life life{held(delay, [](double t) { return t < 5 ? kNowhere : t < 6 ? 0.0 : t < 7 ? 0.004 : t < 8 ? 0.001 : kNowhere; })};
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
    EXPECT_EQ(life.world->session().tool(0).contacts_refused(), 0u);
    life.expect_nothing_broken();
  }
}

/// A plane that swings by 6 mm drives a hand that gives way. Every newton metre of that was paid.
TEST(Contacts, ThatMoveStayWithinTheLedger) {
  for (const double delay : {0.0, 100.0}) {
    netsim::WorldSetup setup = held(delay, [](double t) { return 0.003 * std::sin(2 * t); });
    setup.scene.seats[0].hand.k = 100;
    setup.scene.seats[0].hand.b = 3;
    Life life{std::move(setup)};
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

/// A network that is silent for 60 ms takes nothing away; after 150 ms the plane retreats, and comes back.
TEST(Contacts, OutliveAGapOf100Milliseconds) {
  for (const double gap_ms : {60.0, 200.0}) {
    netsim::WorldSetup setup = held(5, [](double) { return 0.0; });
    netsim::SimpleNetwork net = delayed(5);
    netsim::OutageSpec outage;
    outage.start = 7s;
    outage.length = from_seconds(1e-3 * gap_ms);
    net.outages.push_back(outage);
    setup.network = netsim::link_from(net);
    Life life{std::move(setup)};
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

/// What an engine says is judged before it acts.
TEST(Contacts, ThatAreNoSurfacesAreRefusedAtTheServer) {
  class Broken final : public server::ContactSource {
    void look(const server::ToolView&, LocalContactList& out) noexcept override {
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
  netsim::WorldSetup setup = held(5, {});
  setup.contact_source = [](std::size_t) { return std::make_unique<Broken>(); };
  Life life{std::move(setup)};
  life.until(4s);
  EXPECT_EQ(life.world->session().tool(0).contacts().size, 1u);
  EXPECT_GT(life.world->session().tool(0).contacts_refused(), 3000u);
  EXPECT_NEAR(force_x(life), -series(1000) * hand_x(life), 0.1);
  life.expect_nothing_broken();
}

TEST(Contacts, NeedALawAndAToolThatMeetSurfaces) {
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

/// A rough plane drags a hand that slides over it with mu times the force that presses.
TEST(Contacts, RubAsTheirFrictionSays) {
  netsim::WorldSetup setup = held(50, [](double) { return 0.0; }, 5000, 0.5F);
  setup.scene.seats[0].device.friction = 0;
  setup.scene.seats[0].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}}, {2, {0.006, -0.04, 0}}, {4, {0.006, -0.04, 0}}, {8, {0.006, 0.04, 0}}};
  Life life{std::move(setup)};
  life.until(5500ms);
  double across = 0, along = 0;
  for (int i = 0; i < 1000; ++i) {
    life.step();
    along += life.world->device(0).state().f_out[0];
    across += life.world->device(0).state().f_out[1];
  }
  EXPECT_LT(along, -1000.0);
  EXPECT_NEAR(across / along, 0.5, 0.05) << "against the motion, along +y";
  life.expect_nothing_broken();
}

}  // namespace
}  // namespace tandem
