// Failures found by swarm seeds that had not run before: the smallest scene of each cause, and the seeds themselves.
#include <gtest/gtest.h>

#include <algorithm>

#include "netsim/system/swarm.h"
#include "proto/text/scene_text.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using netsim::Fault;

SceneSpec scene_of(const std::string& text) {
  auto scene = parse_scene(text, "fresh_seeds_test.textproto");
  if (!scene) throw std::logic_error(to_text(scene.error()));
  return std::move(*scene);
}

/// Returns a scene with one axis; `seats` is the text of its seats.
SceneSpec on_one_axis(const std::string& gate, const std::string& seats) {
  return scene_of(
      "version: 1 tick_hz: 1000 dof: 1 duration_s: 30 port: TIP channel { law: SET_POSITION }"
      " device_coupling { k_c_n_m: 400 b_n_s_m: 0.5 m_c_kg: 0.02 } gate { latch: false force_max_n: 3.3 " +
      gate + " } " + seats);
}

constexpr const char* kStillTool =
    "tool { name: \"tool\" k_s_n_m: 400 m_s_kg: 0.05 slave { model: LINEAR damping_n_s_m: 0.2 } }";

/// Returns a hand that presses its tool against a wall from 0.2 s on.
SceneSpec pressing(const std::string& gate) {
  return on_one_axis(
      gate,
      std::string("seat { name: \"hand\" kind: MASTER role: INSTRUCTOR required: true device { damping_n_s_m: 0.2 }"
                  " hand { model: LEADER trajectory { waypoint { at_s: 0.2 x_m: 0.03 } } } }"
                  " tool { name: \"tool\" k_s_n_m: 400 m_s_kg: 0.05 slave { model: LINEAR damping_n_s_m: 0.2"
                  " environment { wall { axis: X at_m: 0.005 k_n_m: 5000 } } } }"
                  " authority { tool: \"tool\" seat: \"hand\" alpha: 1 }"));
}

// Checker `effort_slew` compared with the effort that the program remembered, although the device had dropped it during
// the pause.
TEST(FreshSeeds, StartEffortAtZeroAfterAPauseAsTheCheckerExpects) {
  netsim::SimulationConfig setup =
      test::with(pressing("silence_limit_ms: 100 ramp_in_ms: 1500"), {{Fault::Kind::kPause, "hand", 1200ms, 30ms}});
  setup.network.up.floor = setup.network.down.floor = 15ms;  // a loop of 31 ms must not count as a loss
  test::SessionDriver life(setup);
  life.until(1199ms);
  ASSERT_EQ(life.simulation->seat(0)->gate().phase(), control::GatePhase::kRampIn);
  ASSERT_GT(std::abs(life.simulation->seat(0)->effort()[0]), 0.3) << "else the pause hides nothing";
  life.until(1231ms);
  ASSERT_EQ(life.simulation->seat(0)->gate().phase(), control::GatePhase::kRampIn)
      << "30 ms are less than the silence limit";
  EXPECT_LE(std::abs(life.simulation->seat(0)->effort()[0]), 0.1 + 1e-9) << "10 N/s over at most 10 ms, from zero";
  life.until(4s);
  life.expect_nothing_broken();
}

// The same checker: a slow session's commands are valid longer, and so is the effort after a pause.
TEST(FreshSeeds, ContinueEffortAfterAShortPauseAsTheCheckerExpects) {
  SceneSpec scene = pressing("silence_limit_ms: 100 ramp_in_ms: 1500");
  scene.tick_hz = 500;
  scene.coupling.k_c = 200;
  netsim::SimulationConfig setup = test::with(scene, {{Fault::Kind::kPause, "hand", 1200ms, 24ms}});
  setup.network.up.floor = setup.network.down.floor = 15ms;
  test::SessionDriver life(setup);
  life.until(1198ms);
  const double before = life.simulation->seat(0)->effort()[0];
  ASSERT_GT(std::abs(before), 0.3);
  life.until(1224ms);
  ASSERT_EQ(life.simulation->seat(0)->gate().phase(), control::GatePhase::kRampIn);
  EXPECT_NEAR(life.simulation->seat(0)->effort()[0], before, 0.1 + 1e-9)
      << "26 ms after the last command the device still holds some of it (6 and 20 ms)";
  life.until(4s);
  life.expect_nothing_broken();
}

// Product: the ramp began when a late program noticed the silence, and therefore ended late.
TEST(FreshSeeds, EndAForceInTimeWhenTheProgramWakesUpLate) {
  netsim::SimulationConfig setup =
      test::with(pressing("silence_limit_ms: 20 ramp_in_ms: 100"), {{Fault::Kind::kPause, "hand", 2012ms, 20ms}});
  netsim::NetworkEvent outage;
  outage.at = 2s;
  outage.outage = netsim::OutageSpec{};
  outage.outage->length = 1s;
  setup.events = {outage};
  test::SessionDriver life(setup);
  life.until(2010ms);
  ASSERT_GT(std::abs(life.simulation->seat(0)->effort()[0]), 0.3);
  life.until(2034ms);
  EXPECT_EQ(life.simulation->seat(0)->gate().phase(), control::GatePhase::kReleasing);
  life.until(2124ms);
  const auto& seat = *life.simulation->seat(0);
  EXPECT_NEAR(seat.effort()[0], -5 * seat.sample().port.v[0], 1e-6) << "damping is left, and nothing of the force";
  life.until(5s);
  life.expect_nothing_broken();
}

// Product: the spring of a lost seat pulled at the tool with more than any motor's force while other seats moved the
// tool away.
TEST(FreshSeeds, LimitTheSpringOfALostSeatWhenOthersMoveTheTool) {
  const auto hand = [](const std::string& name, const std::string& role, const std::string& way) {
    return "seat { name: \"" + name + "\" kind: MASTER role: " + role +
           " required: true device { damping_n_s_m: 0.2 } hand { model: LEADER"
           " trajectory {" +
           way + "} } } ";
  };
  netsim::SimulationConfig setup = test::with(on_one_axis(
      "silence_limit_ms: 20",
      hand("leads", "INSTRUCTOR",
           " waypoint { at_s: 0.2 x_m: 0 } waypoint { at_s: 2.03 x_m: 0 } waypoint { at_s: 2.15 x_m: 0.06 } ") +
          hand("is_lost", "TRAINEE", " waypoint { at_s: 0.2 x_m: 0 } ") + kStillTool +
          " authority { tool: \"tool\" seat: \"leads\" alpha: 0.3 } authority { tool: \"tool\" seat: \"is_lost\" "
          "alpha: 0.7 }"));
  netsim::NetworkEvent outage;
  outage.at = 2s;
  outage.clients = {"is_lost"};
  outage.outage = netsim::OutageSpec{};
  outage.outage->length = 1s;
  setup.events = {outage};
  test::SessionDriver life(setup);
  double pull = 0, way = 0;
  life.until(2090ms);
  const double before = life.simulation->session().tool(0).x(0);
  while (life.at() < 2300ms && life.step()) {
    const auto& end = life.simulation->session().seat(1).end().state();
    if (life.alpha(1) <= 0) continue;
    // The reference moves before the tool does: it may be farther than the pull limit by the tool's motion in one tick.
    const auto& tool = life.simulation->session().tool(0);
    pull = std::max(pull, end.k[0] * std::abs(end.ref[0] - (tool.x(0) - tool.port().moved[0])));
    way = std::max(way, std::abs(tool.x(0) - before));
  }
  EXPECT_GT(way, 0.005) << "else no hand moved the tool away";
  EXPECT_LE(pull, 3.3 * (1 + 1e-9)) << "no motor of this scene pulls harder";
  life.until(6s);
  life.expect_nothing_broken();
}

// Product: a server died within half a second after the session's begin. It restarted from a checkpoint without a
// session, and waited only for the seats that the scene requires.
TEST(FreshSeeds, ASessionThatHasJustBegunIsInTheCheckpoint) {
  const std::string hands =
      "seat { name: \"leads\" kind: MASTER role: INSTRUCTOR required: true device { damping_n_s_m: 0.2 } hand { model: "
      "RESTING } }"
      " seat { name: \"helps\" kind: MASTER role: TRAINEE required: false device { damping_n_s_m: 0.2 } hand { model: "
      "RESTING } } ";
  const SceneSpec scene = on_one_axis("", hands + kStillTool +
                                              " authority { tool: \"tool\" seat: \"leads\" alpha: 0.5 } authority { "
                                              "tool: \"tool\" seat: \"helps\" alpha: 0.5 }");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {  // the order of the joins is random
    SCOPED_TRACE(seed);
    netsim::SimulationConfig setup = test::with(scene, {{Fault::Kind::kServerRestart, "", 300ms, 30ms}});
    setup.seed = seed;
    test::SessionDriver life(setup);
    life.until(299ms);
    ASSERT_EQ(life.state(), wire::SessionState::kRunning);
    EXPECT_TRUE(life.simulation->server().checkpoint().begun);
    life.until(335ms);
    EXPECT_TRUE(life.simulation->session().start_condition().recovering());
    life.until(4s);
    EXPECT_EQ(life.state(), wire::SessionState::kRunning);
    life.expect_nothing_broken();
  }
}

// Checker `approach`: a slave's reference moves against this tick's reading. After frozen encoders that reading is far
// from the previous one.
TEST(FreshSeeds, KeepTheApproachSpeedWhenAFrozenSlaveSensorMovesAgain) {
  test::SessionDriver life(test::with(
      on_one_axis(
          "", std::string(
                  "seat { name: \"hand\" kind: MASTER role: INSTRUCTOR required: true device { damping_n_s_m: 0.2 }"
                  " hand { model: LEADER trajectory { circle { radius_m: 0.03 frequency_hz: 0.5 } } } }"
                  " tool { name: \"tool\" k_s_n_m: 400 m_s_kg: 0.05 }"
                  " seat { name: \"slave\" kind: SLAVE tool: \"tool\" required: true device { damping_n_s_m: 0.2 } }"
                  " authority { tool: \"tool\" seat: \"hand\" alpha: 1 }")),
      {{Fault::Kind::kFrozen, "slave", 2s, 300ms}}));
  life.until(2300ms);
  const double frozen = life.simulation->seat(1)->sample().port.x[0];
  ASSERT_TRUE(life.active(1));
  life.until(2302ms);
  const double reach = 3.3 / life.simulation->seat(1)->tools().end(0).state().k[0];
  ASSERT_GT(std::abs(life.simulation->seat(1)->sample().port.x[0] - frozen), reach)
      << "else the reference need not follow its hand at once";
  life.until(6s);
  life.expect_nothing_broken();
}

// Checker `starved`: a tool fell while no seat had authority. A hand that supplies no energy cannot lift it and must
// not. Such a hand holds still, or strokes within the stretch of its spring.
class ToolThatFell : public testing::TestWithParam<const char*> {};

TEST_P(ToolThatFell, PassesTheCheckerWhileTheHandHasNoEnergy) {
  const auto scene = scene_of(
      "version: 1 tick_hz: 1000 dof: 3 duration_s: 30 port: TIP channel { law: SET_POSITION }"
      " device_coupling { k_c_n_m: 400 b_n_s_m: 0.5 m_c_kg: 0.02 } gate { latch: false force_max_n: 2 loop_age_max_ms: "
      "300 }"
      " seat { name: \"hand\" kind: MASTER role: INSTRUCTOR required: true device { damping_n_s_m: 0.2 } hand { model: "
      "LEADER"
      " trajectory { " +
      std::string(GetParam()) +
      " } } }"
      " tool { name: \"tool\" k_s_n_m: 400 m_s_kg: 0.05 slave { model: TOUCH damping_n_s_m: 0.2 gravity_compensation: "
      "false } }"
      " authority { tool: \"tool\" seat: \"hand\" alpha: 1 }");
  netsim::SimulationConfig setup = test::with(scene, {{Fault::Kind::kStopHand, "hand", 1s, 8s}});
  setup.network.up.floor = setup.network.down.floor = 50ms;  // soft springs, far from their limit
  test::SessionDriver life(setup);
  life.until(9100ms);
  const auto apart = [&] {
    double way = 0;
    for (std::size_t a = 0; a < 3; ++a)
      way = std::max(way,
                     std::abs(life.simulation->session().tool(0).x(a) - life.simulation->seat(0)->sample().port.x[a]));
    return way;
  };
  ASSERT_GT(apart(), 0.1) << "else it did not fall";
  ASSERT_TRUE(life.simulation->begin_recovery_phase()) << "else starving is not judged";
  life.until(16s);
  double margin = 1;
  for (std::size_t a = 0; a < 3; ++a)
    margin = std::min(margin, life.simulation->session().seat(0).end().ledger(a).margin());
  EXPECT_LT(margin, 1e-6) << "else its account was enough";
  EXPECT_GT(apart(), 0.02);
  life.expect_nothing_broken();
}

INSTANTIATE_TEST_SUITE_P(FreshSeeds, ToolThatFell,
                         testing::Values("waypoint { at_s: 0.2 x_m: 0 }",
                                         "circle { radius_m: 0.01 frequency_hz: 0.3 }"));

// Swarm: a hand with a sensor reported as frozen waits until the simulated user moves the handle.
TEST(FreshSeeds, AddAPushOfTheSimulatedUserToTheHand) {
  auto device = hal::sim::SimDevice::make({SimDeviceSpec{}, HandSpec{}, {}, nullptr, Time{}});
  ASSERT_TRUE(device);
  const hal::Vec3 home = (*device)->ground_truth().x;
  const auto live = [&](int ms) {
    for (int i = 0; i < ms; ++i) (*device)->advance(hal::Command{}, 1ms);
  };
  (*device)->push({0, 0, 2}, 0.05);
  live(50);
  const double moved = ((*device)->ground_truth().x - home).norm();
  EXPECT_GT(moved, 0.001);
  live(1000);
  const hal::Vec3 rest = (*device)->ground_truth().x;
  live(1000);
  EXPECT_LT(((*device)->ground_truth().x - rest).norm(), 1e-3) << "it ends by itself";
  (*device)->push({std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0.05);
  live(50);
  EXPECT_TRUE((*device)->ground_truth().x.allFinite());
}

// Generator: it printed a force limit that was rounded up. The initial energy was sufficient only for the drawn limit.
TEST(FreshSeeds, DrawValidScenesDespiteRoundedNumbers) {
  EXPECT_NO_THROW(static_cast<void>(netsim::generate_swarm_case(9007199254741413)));
}

void expect_nothing_broken(const netsim::SwarmCase& drawn) {
  const auto result = netsim::run_swarm_case(drawn);
  EXPECT_EQ(result.trouble, "");
  for (const auto& v : result.violations)
    ADD_FAILURE() << v.invariant << " at " << v.seat << ", first at " << v.at_s << " s, " << v.count << " times";
}

class FreshSeed : public testing::TestWithParam<std::uint64_t> {};

TEST_P(FreshSeed, BreaksNoInvariantAndRecovers) { expect_nothing_broken(netsim::generate_swarm_case(GetParam())); }

TEST(FreshSeeds, AShortSessionOfAnIrregularProgramKeepsTheTank) {
  expect_nothing_broken(netsim::generate_swarm_case(5000016, 8));
}

// Checker `approach` took the samples of a client with force separation for the position of its spring.
TEST(FreshSeeds, ForceSeparationMovesNoReferenceAsTheCheckerExpects) {
  for (const std::uint64_t seed : {88000001082, 88000002637}) {
    SCOPED_TRACE(seed);
    expect_nothing_broken(netsim::generate_swarm_case(seed, 20));
  }
}

// Checker `authority_felt` compared forces of the tool, 13.7 N with a motion scale of 0.413, with the limit for hands.
TEST(FreshSeeds, ScaledHandsFeelTheirShareOfAToolsForceAsTheCheckerExpects) {
  expect_nothing_broken(netsim::generate_swarm_case(631830069519, 40, LawKind::kReplica));
}

INSTANTIATE_TEST_SUITE_P(EffortSlew, FreshSeed, testing::Values(700212, 701712, 800062, 910004937));
INSTANTIATE_TEST_SUITE_P(SilenceBrakes, FreshSeed, testing::Values(700891, 801021));
INSTANTIATE_TEST_SUITE_P(AuthorityFelt, FreshSeed, testing::Values(701212, 800191, 802543));
INSTANTIATE_TEST_SUITE_P(Approach, FreshSeed, testing::Values(700724, 700883, 700950, 701694, 701827, 701869));
INSTANTIATE_TEST_SUITE_P(Starved, FreshSeed,
                         testing::Values(5034, 701260, 700655, 801467, 801859, 910000060, 910000272, 910002480,
                                         910005248, 910007677, 910015128));
INSTANTIATE_TEST_SUITE_P(LossEnergy, FreshSeed, testing::Values(910002606, 910009057, 910016151, 318546188308));
INSTANTIATE_TEST_SUITE_P(HandoverLink, FreshSeed, testing::Values(910015457));
INSTANTIATE_TEST_SUITE_P(ManyNames, FreshSeed, testing::Values(910001536));
INSTANTIATE_TEST_SUITE_P(Gathering, FreshSeed, testing::Values(800394));
INSTANTIATE_TEST_SUITE_P(HeldBackAtTheCalm, FreshSeed, testing::Values(257713452818));
INSTANTIATE_TEST_SUITE_P(StuckSensorGuard, FreshSeed, testing::Values(800513));

}  // namespace
}  // namespace tandem
