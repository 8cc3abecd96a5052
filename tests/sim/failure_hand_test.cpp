// Rows of the failure table (design notes, security 2.4, and the role table of 1.5) that are about one hand and its force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/base/counts.h"
#include "tests/sim/life.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using netsim::Fault;
using test::contact;
using test::Life;
using test::with;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

double speed(const Life& life, std::size_t seat) { return life.world->device(seat).state().dx.norm(); }

/// A free hand of the trainee that is torn away now and then.
SceneSpec torn(const std::vector<double>& at) {
  SceneSpec scene = test::shipped("free_motion");
  for (SeatSpec& s : scene.seats) s.hand.deviations.clear();
  scene.timeline.clear();
  scene.duration = 60;
  scene.phases = {{"run", 1, 60, false}};
  for (const double t : at) scene.seats[kTrainee].hand.deviations.push_back({t, 0.04, {60, 0, 0}});
  return scene;
}

// Over-speed: PASSIVE within 3 ms, the others go on; latched after 3 until the person's button.
TEST(FailureTable, AHandThatIsTooFastIsLetGoAndTheThirdTimeLatched) {
  Life life{with(torn({5, 9, 13}))};
  for (int n = 1; n <= 3; ++n) {
    SCOPED_TRACE(n);
    life.until(std::chrono::seconds(1 + 4 * n));
    ASSERT_TRUE(life.active(kTrainee));
    life.time_to([&] { return speed(life, kTrainee) > client::OverSpeed::kSpeedMax; }, 500ms);
    ASSERT_GT(speed(life, kTrainee), client::OverSpeed::kSpeedMax) << "nobody was fast: nothing is tried";
    EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 100ms), 3ms);
    EXPECT_EQ(life.world->seat(kTrainee)->over_speed().trips(), static_cast<unsigned>(n));
    EXPECT_TRUE(life.active(kTrainer));
    life.until(std::chrono::milliseconds(4900 + 4000 * n));
    EXPECT_EQ(life.active(kTrainee), n < 3) << "calm again";
  }
  EXPECT_EQ(life.world->seat(kTrainee)->sample().gate, wire::GateState::kDamped) << "the person is told to press the button";
  life.world->seat(kTrainee)->press_reset();
  life.until(20s);
  EXPECT_TRUE(life.active(kTrainee));
  EXPECT_EQ(life.world->gate_trips(kTrainer), 0u);
  life.expect_nothing_broken();
}

// Motors that are too hot: let go within 3 ms, engaged again once cool, the third time latched until the person's button.
TEST(FailureTable, AHandWhoseMotorsAreTooHotIsLetGoAndTheThirdTimeLatched) {
  const auto hot = [](Duration at) { return Fault{Fault::Kind::kHot, "trainee", at, 1s}; };
  Life life{with(contact(1), {hot(5s), hot(9s), hot(13s)})};
  for (int n = 1; n <= 3; ++n) {
    SCOPED_TRACE(n);
    life.until(std::chrono::seconds(1 + 4 * n));
    ASSERT_TRUE(life.active(kTrainee));
    EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 100ms), 3ms);
    EXPECT_EQ(life.world->seat(kTrainee)->gate().phase(), control::GatePhase::kPassive) << "damped, and no fault";
    EXPECT_EQ(life.world->seat(kTrainee)->over_temperature().trips(), static_cast<unsigned>(n));
    life.until(std::chrono::milliseconds(1990 + 4000 * n));
    EXPECT_FALSE(life.active(kTrainee)) << "still hot";
    EXPECT_TRUE(life.active(kTrainer));
    life.until(std::chrono::milliseconds(4900 + 4000 * n));
    EXPECT_EQ(life.active(kTrainee), n < 3) << "cool again";
  }
  EXPECT_EQ(life.world->seat(kTrainee)->sample().gate, wire::GateState::kDamped) << "the person is told to press the button";
  life.world->seat(kTrainee)->press_reset();
  life.until(20s);
  EXPECT_TRUE(life.active(kTrainee));
  EXPECT_EQ(life.world->gate_trips(kTrainer), 0u);
  life.expect_nothing_broken();
}

// Role table: an evaluator feels with a separate, lower clamp and tank. Both hands follow the same wall press.
TEST(FailureTable, AnEvaluatorGetsHalfTheForceAndHalfTheTank) {
  SceneSpec scene = contact(1);
  scene.seats[kTrainee].role = Role::kEvaluator;
  scene.seats[kTrainee].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}}, {1.5, {0, 0, 0}}, {3, {-0.03, 0, 0}}};  // he pulls back hard
  Life life{with(scene, {{Fault::Kind::kPause, "", 6s, 1ms}})};
  double felt = 0;
  while (life.at() < 10s && life.step()) felt = std::max(felt, life.before[kTrainee].norm());
  const double most = 0.5 * scene.gate.force_max;
  EXPECT_LE(felt, most * (1 + 1e-9));
  EXPECT_GT(felt, 0.9 * most) << "he never felt the clamp";
  EXPECT_DOUBLE_EQ(life.world->seat(kTrainee)->gate().tank_size(), 0.5 * life.world->seat(kTrainer)->gate().tank_size());
  EXPECT_EQ(life.alpha(kTrainee), 0);
  life.expect_nothing_broken();
}

// The same when he is lost: at most half of what others are given, with the hand going along with the force.
TEST(FailureTable, ALostEvaluatorIsGivenAtMostHisOwnTank) {
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
    Life life{setup};
    life.until(7s);
    const control::ForceGate& gate = life.world->seat(kTrainee)->gate();
    EXPECT_GE(gate.trips(), 1u);
    EXPECT_LE(gate.given_after_loss_max(), 0.010 + 1e-3) << "half of 20 mJ";
    life.expect_nothing_broken();
  }
}

}  // namespace
}  // namespace tandem
