// The failure table (tests/FAILURES.md), in virtual time: the rows about participants, seats and the server, each with
// its behaviour and its bound. Other rows: readings and clocks in faults_test.cpp, networks in robustness_test.cpp,
// bytes in tests/common/transport.
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
using test::contact;
using test::SessionDriver;
using test::What;
using test::with;

constexpr double kFelt = 0.2;        // [N/ms] that others may feel of a fault
constexpr double kBelowTank = 1e-3;  // [J] that a hand pulling along overdraws within one tick

constexpr std::size_t kTrainer = 0, kTrainee = 1;

// Client process crash / Authority holder lost: its authority is gone within 220 ms. Others feel at most 0.2 N/ms, and
// the session continues.
TEST(FailureTable, DoesNotDisturbOtherHandsWhenAClientDiesInContact) {
  const std::uint64_t crashes = test::seeds(12);
  for (std::uint64_t n = 0; n < crashes; ++n) {
    SCOPED_TRACE(n);
    const Duration at =
        1500ms + std::chrono::milliseconds(n * 2503 / crashes);  // from before the contact to steady pressing
    SessionDriver life{with(contact(), {{Fault::Kind::kRestart, "trainee", at, 1500ms}})};
    life.until(at);
    life.forget_steps();
    const Duration gone = life.time_to([&] { return life.alpha(kTrainee) == 0; }, 500ms);
    EXPECT_LE(gone, 222ms);
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

// Authority holder lost, no other holder: the tool is braked; authority never moves to an observer.
TEST(FailureTable, BrakesTheToolWhenItsOnlyAuthorityHolderIsLost) {
  SceneSpec scene = contact(1);
  SessionDriver life{with(scene, {{Fault::Kind::kRestart, "trainer", 4s, 1s}})};
  life.until(4s);
  const Duration held = life.time_to([&] { return life.simulation->session().tool(0).authority.held(); }, 500ms);
  EXPECT_LE(held, 222ms);
  life.step();
  EXPECT_EQ(life.state(), wire::SessionState::kHeld);
  while (life.at() < 4900ms) {
    life.step();
    ASSERT_EQ(life.alpha(kTrainee), 0);
  }
  life.until(9s);
  EXPECT_EQ(life.state(), wire::SessionState::kRunning);
  EXPECT_EQ(life.alpha(kTrainer), 1);
  life.expect_nothing_broken();
}

// Instructor console lost: alpha stays, a warning after 10 s, no force changes.
TEST(FailureTable, ChangesNoForceForALostInstructorAndWarnsAfterTenSeconds) {
  SessionDriver life{with(contact(0), {{Fault::Kind::kRestart, "trainer", 5s, 15s}})};
  life.until(5s);
  life.forget_steps();
  const hal::Vec3 force = life.before[kTrainee];
  const std::uint32_t version = life.simulation->session().authority().version();
  life.until(14s);
  EXPECT_EQ(life.audit[What::kInstructorAway], 0);
  life.until(16s);
  EXPECT_EQ(life.audit[What::kInstructorAway], 1);
  EXPECT_EQ(life.alpha(kTrainee), 1);
  EXPECT_EQ(life.simulation->session().authority().version(), version);
  EXPECT_LE((life.before[kTrainee] - force).norm(), 0.1);
  EXPECT_LE(life.steps[kTrainee], 0.05);
  life.expect_nothing_broken();
}

// Two instructors set alpha at the same time: exactly one succeeds, the other receives the new value.
TEST(FailureTable, AcceptsExactlyOneOfTwoConcurrentInstructorChanges) {
  SceneSpec scene = contact();
  scene.seats[1].role = Role::kInstructor;
  SessionDriver life{with(scene)};
  life.until(4s);
  const std::uint32_t version = life.simulation->session().authority().version();
  ASSERT_TRUE(life.simulation->seat(0)->requests().change_authority(0, std::array{1.0, 0.0}));
  ASSERT_TRUE(life.simulation->seat(1)->requests().change_authority(0, std::array{0.0, 1.0}));
  life.until(6s);
  EXPECT_EQ(life.simulation->session().authority().version(), version + 1);
  EXPECT_EQ(life.audit[What::kAuthority], 1);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(life.simulation->seat(i)->force().authority_version, version + 1);
  EXPECT_TRUE(life.alpha(0) == 1 || life.alpha(1) == 1);
  life.expect_nothing_broken();
}

// Partition of both directions and of each direction alone. The isolated side has a link loss, the other seats
// continue. After the partition the isolated hand ramps in.
TEST(FailureTable, LimitsAPartitionToTheIsolatedSide) {
  for (const std::optional<netsim::Direction> direction :
       {std::optional<netsim::Direction>{}, {netsim::Direction::kUp}, {netsim::Direction::kDown}}) {
    SCOPED_TRACE(direction ? static_cast<int>(*direction) : -1);
    auto setup = with(contact());
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
    const Duration let_go = life.time_to([&] { return !life.active(kTrainee); }, 500ms);
    // With only the upward direction cut, the seat receives all data but no echoes. The loop age then shows the loss
    // (20 ms above the learned age).
    EXPECT_LE(let_go, direction == netsim::Direction::kUp ? 26ms : 22ms);
    const bool downward_only = direction == netsim::Direction::kDown;
    const Duration gone = life.time_to([&] { return life.alpha(kTrainee) == 0; }, 500ms);
    EXPECT_LE(let_go + gone, downward_only ? 140ms : 222ms) << "a STATE with this flag is detected sooner than silence";
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

// Random loss: no gate trip at 5 % random loss; 20 lost datagrams in a row cause one trip.
TEST(FailureTable, TripsNoGateOnRandomLossButOnTwentyLossesInARow) {
  for (const double percent : {1.0, 5.0}) {
    auto setup = with(contact());
    setup.network = netsim::link_from(test::delayed(5, 0, percent));
    SessionDriver life{setup};
    life.until(15s);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(life.simulation->client(i).program().gate_trips(), 0u) << percent;
    life.expect_nothing_broken();
  }
  auto setup = with(contact());
  netsim::NetworkEvent cut;
  cut.at = 5s;
  cut.direction = netsim::Direction::kDown;
  netsim::OutageSpec outage;
  outage.length = 22ms;
  cut.outage = outage;
  setup.events = {cut};
  SessionDriver life{setup};
  life.until(8s);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(life.simulation->client(i).program().gate_trips(), 1u);
  life.expect_nothing_broken();
}

// Frozen sensor: release after 100 ms in which the hand should have moved 5 mm; no other seat is affected.
TEST(FailureTable, DetectsAFrozenSensorWhereMotionIsExpected) {
  SceneSpec scene = test::shipped("free_motion");
  for (auto& s : scene.seats) s.hand.deviations.clear();
  scene.timeline.clear();
  scene.duration = 15;
  scene.phases = {{"run", 1, 15, false}};
  SessionDriver life{with(scene, {{Fault::Kind::kFrozen, "trainee", 6s, 800ms}})};
  life.until(6s);
  ASSERT_TRUE(life.active(kTrainee));
  const Duration found = life.time_to([&] { return !life.active(kTrainee); }, 700ms);
  EXPECT_GT(found, 100ms);
  EXPECT_LE(found, 160ms) << "at 0.157 m/s 5 mm take 32 ms";
  EXPECT_TRUE(life.simulation->seat(kTrainee)->guards().stuck_sensor().stuck());
  EXPECT_TRUE(life.active(kTrainer));
  life.until(10s);
  EXPECT_TRUE(life.active(kTrainee)) << "the reading moves again";
  EXPECT_EQ(life.simulation->client(kTrainer).program().gate_trips(), 0u);
  life.expect_nothing_broken();
}

// Stop pressed, local: within 5 ms, latched; authority decays as for a lost holder; the same user resumes.
TEST(FailureTable, LatchesALocalStopUntilItsUserResumes) {
  SessionDriver life{with(contact())};
  life.until(5s);
  life.forget_steps();
  life.simulation->seat(kTrainee)->requests().stop_locally();
  EXPECT_LE(life.time_to([&] { return !life.active(kTrainee); }, 100ms), 5ms);
  EXPECT_LE(life.time_to([&] { return life.alpha(kTrainee) == 0; }, 500ms), 220ms);
  life.until(8s);
  EXPECT_FALSE(life.active(kTrainee)) << "latched";
  EXPECT_TRUE(life.active(kTrainer));
  EXPECT_EQ(life.state(), wire::SessionState::kRunning);
  EXPECT_LE(life.steps[kTrainer], kFelt);
  EXPECT_EQ(life.audit[What::kLocalStop], 1);
  life.simulation->seat(kTrainer)->requests().resume();
  life.until(9s);
  EXPECT_FALSE(life.active(kTrainee)) << "another participant's button";
  life.simulation->seat(kTrainee)->requests().resume();
  life.until(12s);
  EXPECT_TRUE(life.active(kTrainee));
  EXPECT_EQ(life.audit[What::kLocalResume], 1);
  life.expect_nothing_broken();
}

// Stop pressed by the instructor for all: RTT and one tick; latched; the instructor resumes without an abrupt force.
TEST(FailureTable, ReleasesAllHandsWithinARoundTripAndATickOfAnInstructorsStop) {
  for (const int one_way : {0, 5, 12}) {
    SCOPED_TRACE(one_way);
    auto setup = with(contact());
    setup.network = netsim::link_from(test::delayed(one_way));
    SessionDriver life{setup};
    life.until(5s);
    ASSERT_TRUE(life.active(kTrainer) && life.active(kTrainee));
    ASSERT_TRUE(life.simulation->seat(kTrainer)->requests().stop_all());
    const Duration all = life.time_to([&] { return !life.active(kTrainer) && !life.active(kTrainee); }, 500ms);
    EXPECT_LE(all, std::chrono::milliseconds(2 * one_way) + 2ms) << "a tick, and the one of the key press";
    EXPECT_EQ(life.state(), wire::SessionState::kStopped);
    EXPECT_TRUE(life.simulation->session().tool(0).authority.held());
    life.until(8s);
    EXPECT_FALSE(life.active(kTrainer) || life.active(kTrainee)) << "latched";
    life.simulation->seat(kTrainee)->requests().resume();
    life.until(9s);
    EXPECT_EQ(life.state(), wire::SessionState::kStopped) << "the trainee may not end it";
    life.simulation->seat(kTrainer)->requests().resume();
    life.time_to([&] { return life.active(kTrainer) && life.active(kTrainee); }, 2s);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(life.before[i].norm(), 0.05) << "bumpless";
    life.until(13s);
    EXPECT_EQ(life.state(), wire::SessionState::kRunning);
    EXPECT_TRUE(life.active(kTrainer) && life.active(kTrainee));
    EXPECT_EQ(life.audit[What::kStop], 1);
    EXPECT_EQ(life.audit[What::kResume], 1);
    life.expect_nothing_broken();
  }
}

TEST(FailureTable, ATraineePausesAndTheInstructorResumes) {
  auto setup = with(contact());
  setup.network = netsim::link_from(test::delayed(10, 5, 20));  // requests are repeated until the server confirms them
  SessionDriver life{setup};
  life.until(6s);
  ASSERT_TRUE(life.simulation->seat(kTrainee)->requests().stop_all());
  life.until(7s);
  EXPECT_EQ(life.state(), wire::SessionState::kPaused);
  EXPECT_EQ(life.simulation->session().stop_control().latch().stops(), 1u) << "repeated, and one stop";
  life.simulation->seat(kTrainer)->requests().resume();
  life.until(8s);
  EXPECT_NE(life.state(), wire::SessionState::kPaused);
  EXPECT_EQ(life.audit[What::kPause], 1);
  life.expect_nothing_broken();
}

// Hostile authenticated client: quarantined. The others' force changes by at most 0.2 N/ms, and not at all if that
// client had no authority.
TEST(FailureTable, QuarantinesAHostileClientWithoutDisturbingOtherHands) {
  for (const double trainer : {1.0, 0.5}) {
    SCOPED_TRACE(trainer);
    SessionDriver life{with(contact(trainer), {{Fault::Kind::kHostile, "trainee", 5s, 1s}})};
    life.until(5s);
    const hal::Vec3 force = life.before[kTrainer];
    const std::uint32_t version = life.simulation->session().authority().version();
    life.forget_steps();
    // One of six kinds of attack is drawn each tick; a request for authority is not a malformed message.
    EXPECT_LE(life.time_to(
                  [&] {
                    return life.simulation->session().seat(kTrainee).misbehaviour().quarantined(life.simulation->now());
                  },
                  100ms),
              5ms);
    life.until(5990ms);
    EXPECT_EQ(life.simulation->session().authority().version(), version);
    EXPECT_LE(life.steps[kTrainer], kFelt);
    EXPECT_LE((life.before[kTrainer] - force).norm(), trainer == 1 ? kFelt : 3.3)
        << "a hand without authority is not felt";
    EXPECT_TRUE(life.active(kTrainer));
    EXPECT_FALSE(life.active(kTrainee));
    EXPECT_GE(life.audit[What::kQuarantined], 1);
    life.until(10s);
    EXPECT_TRUE(life.active(kTrainee)) << "the trainee behaves again";
    life.expect_nothing_broken();
  }
}

}  // namespace
}  // namespace tandem
