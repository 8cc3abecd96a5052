// Rows of the failure table (tests/FAILURES.md) about one hand and its force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/common/base/counts.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using netsim::Fault;
using test::contact;
using test::SessionDriver;
using test::with;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

double speed(const SessionDriver& life, std::size_t seat) { return life.simulation->device(seat).state().dx.norm(); }

/// Returns a scene in which the trainee's free hand is pulled away at these times [s].
SceneSpec torn(const std::vector<double>& at) {
  SceneSpec scene = test::shipped("free_motion");
  for (SeatSpec& s : scene.seats) s.hand.deviations.clear();
  scene.timeline.clear();
  scene.duration = 60;
  scene.phases = {{"run", 1, 60, false}};
  for (const double t : at) scene.seats[kTrainee].hand.deviations.push_back({t, 0.04, {60, 0, 0}});
  return scene;
}

// Over-speed: RELEASING within 3 ms, the other seats continue; LATCHED at the third time, until the user presses the
// button.
TEST(FailureTable, ReleasesATooFastHandAndLatchesItTheThirdTime) {
  SessionDriver life{with(torn({5, 9, 13}))};
  for (int n = 1; n <= 3; ++n) {
    SCOPED_TRACE(n);
    life.until(std::chrono::seconds(1 + 4 * n));
    ASSERT_TRUE(life.active(kTrainee));
    life.time_to([&] { return speed(life, kTrainee) > control::OverspeedGuard::kSpeedMax; }, 500ms);
    ASSERT_GT(speed(life, kTrainee), control::OverspeedGuard::kSpeedMax) << "no hand was fast: the test proves nothing";
    EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 100ms), 3ms);
    EXPECT_EQ(life.simulation->seat(kTrainee)->guards().overspeed().trips(), static_cast<unsigned>(n));
    EXPECT_TRUE(life.active(kTrainer));
    life.until(std::chrono::milliseconds(4900 + 4000 * n));
    EXPECT_EQ(life.active(kTrainee), n < 3) << "at rest again";
  }
  EXPECT_EQ(life.simulation->seat(kTrainee)->sample().gate, wire::GateState::kLatched)
      << "the client asks the participant to press the button";
  life.simulation->seat(kTrainee)->requests().reset_gate();
  life.until(20s);
  EXPECT_TRUE(life.active(kTrainee));
  EXPECT_EQ(life.simulation->client(kTrainer).program().gate_trips(), 0u);
  life.expect_nothing_broken();
}

// Motors that are too hot: release within 3 ms, engaged again after cooling. At the third time LATCHED until the user
// presses the button.
TEST(FailureTable, ReleasesAHandWithHotMotorsAndLatchesItTheThirdTime) {
  const auto hot = [](Duration at) { return Fault{Fault::Kind::kHot, "trainee", at, 1s}; };
  SessionDriver life{with(contact(1), {hot(5s), hot(9s), hot(13s)})};
  for (int n = 1; n <= 3; ++n) {
    SCOPED_TRACE(n);
    life.until(std::chrono::seconds(1 + 4 * n));
    ASSERT_TRUE(life.active(kTrainee));
    EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 100ms), 3ms);
    EXPECT_EQ(life.simulation->seat(kTrainee)->gate().phase(), control::GatePhase::kReleasing)
        << "damped, and no fault";
    EXPECT_EQ(life.simulation->seat(kTrainee)->guards().overtemperature().trips(), static_cast<unsigned>(n));
    life.until(std::chrono::milliseconds(1990 + 4000 * n));
    EXPECT_FALSE(life.active(kTrainee)) << "still hot";
    EXPECT_TRUE(life.active(kTrainer));
    life.until(std::chrono::milliseconds(4900 + 4000 * n));
    EXPECT_EQ(life.active(kTrainee), n < 3) << "cool again";
  }
  EXPECT_EQ(life.simulation->seat(kTrainee)->sample().gate, wire::GateState::kLatched)
      << "the client asks the participant to press the button";
  life.simulation->seat(kTrainee)->requests().reset_gate();
  life.until(20s);
  EXPECT_TRUE(life.active(kTrainee));
  EXPECT_EQ(life.simulation->client(kTrainer).program().gate_trips(), 0u);
  life.expect_nothing_broken();
}

// Role table: an evaluator has a separate, lower force limit and tank. Both hands follow the same press on a wall.
TEST(FailureTable, AnEvaluatorGetsHalfTheForceAndHalfTheTank) {
  SceneSpec scene = contact(1);
  scene.seats[kTrainee].role = Role::kEvaluator;
  scene.seats[kTrainee].hand.trajectory.waypoints = {
      {0.5, {-0.02, 0, 0}}, {1.5, {0, 0, 0}}, {3, {-0.03, 0, 0}}};  // the evaluator pulls back hard
  SessionDriver life{with(scene, {{Fault::Kind::kPause, "", 6s, 1ms}})};
  double felt = 0;
  while (life.at() < 10s && life.step()) felt = std::max(felt, life.before[kTrainee].norm());
  const double most = 0.5 * scene.gate.force_max;
  EXPECT_LE(felt, most * (1 + 1e-9));
  EXPECT_GT(felt, 0.9 * most) << "the hand never felt the clamp";
  EXPECT_DOUBLE_EQ(life.simulation->seat(kTrainee)->gate().tank().size(),
                   0.5 * life.simulation->seat(kTrainer)->gate().tank().size());
  EXPECT_EQ(life.alpha(kTrainee), 0);
  life.expect_nothing_broken();
}

// After a loss: at most half of the energy for other roles, with a hand that moves along with the force.
TEST(FailureTable, GivesALostEvaluatorAtMostItsOwnTank) {
  const std::uint64_t losses = test::seeds(6);
  for (std::uint64_t n = 0; n < losses; ++n) {
    SCOPED_TRACE(n);
    SceneSpec scene = contact(1);
    scene.seats[kTrainee].role = Role::kEvaluator;
    auto setup = with(scene);
    netsim::NetworkEvent cut;
    cut.at = 1500ms + std::chrono::milliseconds(n * 3001 / losses);
    cut.clients = {"trainee"};
    cut.direction = netsim::Direction::kDown;
    netsim::OutageSpec outage;
    outage.length = 1s;
    cut.outage = outage;
    setup.events = {cut};
    SessionDriver life{setup};
    life.until(7s);
    const control::ForceGate& gate = life.simulation->seat(kTrainee)->gate();
    EXPECT_GE(gate.trips(), 1u);
    EXPECT_LE(gate.tank().given_max(), 0.010 + 1e-3) << "half of 20 mJ";
    life.expect_nothing_broken();
  }
}

}  // namespace
}  // namespace tandem
