// Rows of the failure table (tests/FAILURES.md) under law `replica`, whose hands tolerate longer silences. The tool
// waits for a hand as long as that hand's gate tolerates, 450 ms at most. Its authority then decays in 100 ms, as under
// the other law.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "tests/common/base/counts.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using netsim::Fault;
using test::SessionDriver;
using test::What;
using test::with;

constexpr double kFelt = 0.2;        // [N/ms] that others may feel of a fault
constexpr double kBelowTank = 1e-3;  // [J] that a hand pulling along overdraws within one tick
constexpr Duration kBorne = 450ms, kWeightGone = kBorne + 122ms;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

/// Returns a scene in which two hands lead a virtual tool and press it 8 mm into bone from 3 s on.
SceneSpec pressing(double trainer = 0.5) {
  SceneSpec scene = test::shipped("contact");
  EXPECT_EQ(scene.channel.law, LawKind::kReplica);
  scene.seats[0].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}}, {1.5, {0, 0, 0}}, {3, {0.008, 0, 0}}};
  scene.seats[1].hand = scene.seats[0].hand;
  scene.authority[0].alpha = {trainer, 1 - trainer};
  scene.timeline.clear();
  scene.duration = 60;
  scene.phases = {{"press", 3, 60, false}};
  return scene;
}

TEST(FailureReplica, DoesNotDisturbOtherHandsWhenAClientDiesInContact) {
  const std::uint64_t crashes = test::seeds(12);
  for (std::uint64_t n = 0; n < crashes; ++n) {
    SCOPED_TRACE(n);
    const Duration at =
        1500ms + std::chrono::milliseconds(n * 2503 / crashes);  // from before the contact to steady pressing
    SessionDriver life{with(pressing(), {{Fault::Kind::kRestart, "trainee", at, 1500ms}})};
    life.until(at);
    life.forget_steps();
    EXPECT_LE(life.time_to([&] { return life.alpha(kTrainee) == 0; }, 1s), kWeightGone);
    life.until(at + 1400ms);
    EXPECT_LE(life.steps[kTrainer], kFelt);
    EXPECT_EQ(life.state(), wire::SessionState::kRunning);
    EXPECT_EQ(life.alpha(kTrainer), 1);
    EXPECT_TRUE(life.active(kTrainer));
    life.until(at + 5s);
    EXPECT_TRUE(life.active(kTrainee)) << "the trainee is back";
    EXPECT_NEAR(life.alpha(kTrainee), 0.5, 1e-9);
    EXPECT_GE(life.audit[What::kLoss], 1);
    life.expect_nothing_broken();
  }
}

TEST(FailureReplica, BrakesTheToolWhenItsOnlyAuthorityHolderIsLost) {
  SessionDriver life{with(pressing(1), {{Fault::Kind::kRestart, "trainer", 4s, 1s}})};
  life.until(4s);
  EXPECT_LE(life.time_to([&] { return life.simulation->session().tool(0).authority.held(); }, 1s), kWeightGone);
  while (life.at() < 4900ms) {
    life.step();
    ASSERT_EQ(life.alpha(kTrainee), 0);
  }
  EXPECT_EQ(life.state(), wire::SessionState::kHeld);
  life.until(9s);
  EXPECT_EQ(life.state(), wire::SessionState::kRunning);
  EXPECT_EQ(life.alpha(kTrainer), 1);
  life.expect_nothing_broken();
}

TEST(FailureReplica, ChangesNoForceForALostInstructorAndWarnsAfterTenSeconds) {
  SessionDriver life{with(pressing(0), {{Fault::Kind::kRestart, "trainer", 5s, 15s}})};
  life.until(5s);
  life.forget_steps();
  const hal::Vec3 force = life.before[kTrainee];
  life.until(14s);
  EXPECT_EQ(life.audit[What::kInstructorAway], 0);
  life.until(16s);
  EXPECT_EQ(life.audit[What::kInstructorAway], 1);
  EXPECT_EQ(life.alpha(kTrainee), 1);
  EXPECT_LE((life.before[kTrainee] - force).norm(), 0.1);
  EXPECT_LE(life.steps[kTrainee], 0.05);
  life.expect_nothing_broken();
}

TEST(FailureReplica, LimitsAPartitionToTheIsolatedSide) {
  for (const std::optional<netsim::Direction> direction :
       {std::optional<netsim::Direction>{}, {netsim::Direction::kUp}, {netsim::Direction::kDown}}) {
    SCOPED_TRACE(direction ? static_cast<int>(*direction) : -1);
    auto setup = with(pressing());
    netsim::NetworkEvent cut;
    cut.at = 4s;
    cut.clients = {"trainee"};
    cut.direction = direction;
    netsim::OutageSpec outage;
    outage.length = 2s;
    cut.outage = outage;
    setup.events = {cut};
    SessionDriver life{setup};
    life.until(4s);
    life.forget_steps();
    EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 1s), kBorne + 26ms);
    life.time_to([&] { return life.alpha(kTrainee) == 0; }, 1s);
    EXPECT_LE(life.at() - 4s, kWeightGone + 26ms);
    life.until(5900ms);
    EXPECT_LE(life.steps[kTrainer], kFelt);
    EXPECT_TRUE(life.active(kTrainer));
    EXPECT_LE(life.simulation->seat(kTrainee)->gate().tank().given_max(),
              life.simulation->seat(kTrainee)->gate().tank().size() + kBelowTank);
    life.until(9s);
    EXPECT_TRUE(life.active(kTrainee));
    life.expect_nothing_broken();
  }
}

TEST(FailureReplica, LatchesALocalStopUntilItsUserResumes) {
  SessionDriver life{with(pressing())};
  life.until(5s);
  life.forget_steps();
  life.simulation->seat(kTrainee)->requests().stop_locally();
  EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 100ms), 5ms);
  EXPECT_LE(life.time_to([&] { return life.alpha(kTrainee) == 0; }, 500ms), 220ms);
  life.until(8s);
  EXPECT_FALSE(life.active(kTrainee)) << "latched";
  EXPECT_TRUE(life.active(kTrainer));
  EXPECT_LE(life.steps[kTrainer], kFelt);
  life.simulation->seat(kTrainee)->requests().resume();
  life.until(12s);
  EXPECT_TRUE(life.active(kTrainee));
  life.expect_nothing_broken();
}

TEST(FailureReplica, ReleasesAllHandsWithinARoundTripAndATickOfAnInstructorsStop) {
  for (const int one_way : {0, 5, 12}) {
    SCOPED_TRACE(one_way);
    auto setup = with(pressing());
    setup.network = netsim::link_from(test::delayed(one_way));
    SessionDriver life{setup};
    life.until(5s);
    ASSERT_TRUE(life.active(kTrainer) && life.active(kTrainee));
    ASSERT_TRUE(life.simulation->seat(kTrainer)->requests().stop_all());
    const Duration all = life.time_to([&] { return !life.active(kTrainer) && !life.active(kTrainee); }, 500ms);
    EXPECT_LE(all, std::chrono::milliseconds(2 * one_way) + 2ms) << "a tick, and the one of the key press";
    EXPECT_TRUE(life.simulation->session().tool(0).authority.held());
    life.until(8s);
    life.simulation->seat(kTrainer)->requests().resume();
    life.time_to([&] { return life.active(kTrainer) && life.active(kTrainee); }, 2s);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(life.before[i].norm(), 0.05) << "bumpless";
    life.until(13s);
    EXPECT_TRUE(life.active(kTrainer) && life.active(kTrainee));
    life.expect_nothing_broken();
  }
}

TEST(FailureReplica, QuarantinesAHostileClientWithoutDisturbingOtherHands) {
  for (const double trainer : {1.0, 0.5}) {
    SCOPED_TRACE(trainer);
    SessionDriver life{with(pressing(trainer), {{Fault::Kind::kHostile, "trainee", 5s, 1s}})};
    life.until(5s);
    const hal::Vec3 force = life.before[kTrainer];
    life.forget_steps();
    EXPECT_LE(life.time_to(
                  [&] {
                    return life.simulation->session().seat(kTrainee).misbehaviour().quarantined(life.simulation->now());
                  },
                  100ms),
              5ms);
    life.until(5990ms);
    EXPECT_LE(life.steps[kTrainer], kFelt);
    EXPECT_LE((life.before[kTrainer] - force).norm(), trainer == 1 ? 0.01 : 3.3)
        << "a hand without authority is not felt";
    EXPECT_TRUE(life.active(kTrainer));
    EXPECT_FALSE(life.active(kTrainee));
    life.until(10s);
    EXPECT_TRUE(life.active(kTrainee)) << "the trainee behaves again";
    life.expect_nothing_broken();
  }
}

// The server dies in contact and restarts from its checkpoint. All clients join again, and no force starts abruptly.
TEST(FailureReplica, RestartsAServerInContactWithoutAForceStep) {
  for (const Duration gone : {500ms, 1500ms, 3000ms}) {
    SCOPED_TRACE(seconds(gone));
    SessionDriver life{with(pressing(), {{Fault::Kind::kServerRestart, "", 5s, gone}})};
    life.until(5s);
    ASSERT_TRUE(life.active(kTrainer) && life.active(kTrainee));
    const double tool = life.simulation->session().tool(0).x(0);
    life.until(5s + gone);
    life.forget_steps();
    life.time_to([&] { return life.active(kTrainer) && life.active(kTrainee); }, 5s);
    EXPECT_TRUE(life.active(kTrainer) && life.active(kTrainee));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(life.before[i].norm(), 0.05) << "first tick";
    life.until(5s + gone + 6s);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(life.steps[i], kFelt);
    EXPECT_NEAR(life.simulation->session().tool(0).x(0), tool, 2e-4);
    EXPECT_EQ(life.state(), wire::SessionState::kRunning);
    life.expect_nothing_broken();
  }
}

}  // namespace
}  // namespace tandem
