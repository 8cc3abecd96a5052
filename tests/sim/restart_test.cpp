// The server dies and restarts from its checkpoint (ARCHITECTURE.md, invariant 39): no abrupt force, no jump, and all
// seats return.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "tests/common/base/counts.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using netsim::Fault;

constexpr double kFirst = 0.05;      // [N] in the first millisecond
constexpr double kBeyond = 0.3;      // [N] beyond the environment's own force, in the first 500 ms
constexpr double kInjected = 0.005;  // [J] in that time

/// Work and force of a motor on the hand in the first 500 ms after its gate engages again.
class Engagement {
 public:
  /// @param environment  force on the tool [N]
  void look(const netsim::Simulation& simulation, std::size_t seat, double environment) {
    const bool active = simulation.seat(seat) != nullptr && simulation.seat(seat)->gate().active();
    const hal::Vec3 x = simulation.device(seat).ground_truth().x;
    const double force = simulation.device(seat).state().f_out.norm();
    if (active && !was_active_) {
      since_ = simulation.now();
      first = force;
      ++count;
    }
    if (active && count > 0 && simulation.now() - since_ < 500ms) {
      beyond = std::max(beyond, force - environment);
      energy_ += simulation.device(seat).state().f_out.dot(x - x_);
      injected = std::max(injected, energy_);
    }
    was_active_ = active;
    x_ = x;
  }
  void begin_anew() { *this = Engagement{}; }
  int count = 0;
  double first = 0, beyond = 0, injected = 0;

 private:
  bool was_active_ = true;
  Time since_{};
  double energy_ = 0;
  hal::Vec3 x_ = hal::Vec3::Zero();
};

SceneSpec pressing() {
  SceneSpec scene = test::set_position("contact");
  scene.seats[0].hand.trajectory.waypoints = {{0.5, {-0.02, 0, 0}}, {1.5, {0, 0, 0}}, {3, {0.012, 0, 0}}};
  scene.seats[1].hand = scene.seats[0].hand;
  scene.authority[0].alpha = {0.5, 0.5};
  scene.timeline.clear();
  scene.duration = 60;
  scene.phases = {{"press", 3, 60, false}};
  return scene;
}

TEST(ServerRestart, RestoresAllHandsWithoutAForceStepAtAnyTickOfAContact) {
  const std::uint64_t restarts = test::seeds(10);
  for (std::uint64_t n = 0; n < restarts; ++n) {
    SCOPED_TRACE(n);
    const Duration at = 4s + std::chrono::milliseconds(n * 997 / restarts);
    const Duration down = 300ms + std::chrono::milliseconds(n * 131 % 900);
    netsim::SimulationConfig setup{.scene = pressing()};
    setup.faults = {{Fault::Kind::kServerRestart, "", at, down}};
    auto made = netsim::Simulation::make(setup);
    ASSERT_TRUE(made);
    netsim::Simulation& simulation = **made;
    std::map<server::AuditEvent::What, int> audit;
    simulation.on_audit = [&](const server::AuditEvent& e) { ++audit[e.what]; };
    std::array<Engagement, 2> hands;
    server::Checkpoint left{};
    bool restarted = false;
    Duration back{};
    std::array<Duration, 2> let_go{};
    while (simulation.now() < Time{} + at + down + 5s && simulation.step()) {
      const Duration now = simulation.now() - Time{};
      if (simulation.server().up() && !restarted && now <= at) left = simulation.server().checkpoint();
      if (simulation.server().up() && now > at && !restarted) {  // the first tick of the new server
        restarted = true;
        EXPECT_EQ(simulation.session().epoch(), left.epoch + 1);
        EXPECT_EQ(simulation.session().tool(0).slave()->state().q, left.tools[0].slave) << "to the encoder's count";
        for (const double e : simulation.session().tool(0).velocity()) EXPECT_EQ(e, 0);
      }
      if (now <= at) continue;
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& gate = simulation.seat(i)->gate();
        if (let_go[i] == Duration{} && !gate.active()) let_go[i] = now - at;
        hands[i].look(simulation, i, simulation.session().tool(0).slave()->state().f_env.norm());
        if (now > at + 125ms && now < at + down) {  // the remaining force may brake a hand and never push it
          const double power = simulation.device(i).state().f_out.dot(simulation.device(i).ground_truth().dx);
          EXPECT_LE(power, 1e-4) << now.count();
        }
      }
      if (back == Duration{} && restarted && hands[0].count > 0 && hands[1].count > 0 &&
          simulation.seat(0)->gate().phase() == control::GatePhase::kActive &&
          simulation.seat(1)->gate().phase() == control::GatePhase::kActive)
        back = now - at - down;
    }
    EXPECT_EQ(simulation.trouble(), "");
    EXPECT_TRUE(simulation.violations().passed());
    for (const auto& v : simulation.violations().list())
      EXPECT_TRUE(v.expected) << v.invariant << " " << v.seat << " at " << v.at_s;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(let_go[i], 22ms);
      EXPECT_EQ(hands[i].count, 1);
      EXPECT_LE(hands[i].first, kFirst);
      EXPECT_LE(hands[i].beyond, kBeyond);
      EXPECT_LE(hands[i].injected, kInjected);
      EXPECT_LE(simulation.seat(i)->gate().tank().given_max(), simulation.seat(i)->gate().tank().size() + 1e-3);
    }
    EXPECT_GT(back, 0s);
    EXPECT_LE(back, 3s);
    EXPECT_EQ(audit[server::AuditEvent::What::kRestored], 1);
    EXPECT_EQ(audit[server::AuditEvent::What::kAllBack], 1);
    EXPECT_EQ(simulation.session().tool(0).authority.requested()[0], 0.5);
  }
}

TEST(ServerRestart, EngagesNoHandUntilAuthorityHoldersReturnOrTheInstructorResumes) {
  for (const bool goes_on : {false, true}) {
    netsim::SimulationConfig setup{.scene = pressing()};
    setup.faults = {{Fault::Kind::kServerRestart, "", 4s, 500ms}, {Fault::Kind::kRestart, "trainee", 4100ms, 4s}};
    auto made = netsim::Simulation::make(setup);
    ASSERT_TRUE(made);
    netsim::Simulation& simulation = **made;
    while (simulation.now() < Time{} + 7s && simulation.step()) {
    }
    EXPECT_TRUE(simulation.session().start_condition().recovering());
    EXPECT_EQ(simulation.session().state(), wire::SessionState::kWaiting);
    EXPECT_FALSE(simulation.seat(0)->gate().active());
    EXPECT_EQ(simulation.session().start_condition().missing(simulation.now()), (std::vector<std::size_t>{1}));
    if (goes_on) simulation.seat(0)->requests().resume();
    while (simulation.now() < Time{} + 8s && simulation.step()) {
    }
    EXPECT_EQ(simulation.session().start_condition().recovering(), !goes_on);
    EXPECT_EQ(simulation.seat(0)->gate().active(), goes_on);
    EXPECT_EQ(simulation.session().tool(0).authority.alpha(0), goes_on ? 1 : 0);
    while (simulation.now() < Time{} + 12s && simulation.step()) {
    }
    EXPECT_FALSE(simulation.session().start_condition().recovering());
    for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(simulation.seat(i)->gate().active()) << i;
    EXPECT_NEAR(simulation.session().tool(0).authority.alpha(1), 0.5, 1e-9);
    EXPECT_TRUE(simulation.violations().passed());
  }
}

TEST(ServerRestart, PreservesAStop) {
  netsim::SimulationConfig setup{.scene = pressing()};
  setup.faults = {{Fault::Kind::kServerRestart, "", 5s, 500ms}};
  auto made = netsim::Simulation::make(setup);
  ASSERT_TRUE(made);
  netsim::Simulation& simulation = **made;
  const auto until = [&](Duration end) {
    while (simulation.now() < Time{} + end && simulation.step()) {
    }
  };
  until(4s);
  ASSERT_TRUE(simulation.seat(0)->requests().stop_all());
  simulation.seat(1)->requests().stop_locally();
  until(4900ms);
  const std::uint32_t stops = simulation.session().stop_control().latch().stops();
  EXPECT_EQ(stops, 1u);
  until(6s);
  simulation.seat(1)->requests().resume();  // its own hand; otherwise the session waits for it
  until(8s);
  EXPECT_EQ(simulation.session().state(), wire::SessionState::kStopped);
  EXPECT_GT(simulation.session().stop_control().latch().stops(), stops)
      << "under a new number: an old request to resume is void";
  for (std::size_t i = 0; i < 2; ++i) EXPECT_FALSE(simulation.seat(i)->gate().active());
  simulation.seat(0)->requests().resume();
  until(11s);
  EXPECT_EQ(simulation.session().state(), wire::SessionState::kRunning);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(simulation.seat(i)->gate().active());
  EXPECT_TRUE(simulation.violations().passed());
}

// Bumpless re-attach: the hand moved 0 to 150 mm while its program was down, and holds still there.
TEST(Reattach, EngagesAMovedHandWithoutAForceStep) {
  const std::uint64_t runs = test::draws(40, 1000, 1000);
  std::printf("[  seeds   ] %llu re-attachments\n", static_cast<unsigned long long>(runs));
  RandomStream random{17};
  for (std::uint64_t n = 0; n < runs; ++n) {
    SCOPED_TRACE(n);
    SceneSpec scene = test::shipped("one_axis");
    const double offset = random.uniform(0, 0.150) * (random.below(2) == 0 ? 1 : -1);
    scene.seats[0].hand.trajectory.kind = Trajectory::Kind::kWaypoints;
    scene.seats[0].hand.trajectory.waypoints = {{0.1, {0, 0, 0}}, {1.2, {0, 0, 0}}, {1.8, {offset, 0, 0}}};
    scene.duration = 10;
    netsim::SimulationConfig setup{.scene = scene, .seed = n + 1};
    const bool server = random.below(2) == 0;  // the server dies or the network fails: a new connection, or none
    setup.faults = {
        {server ? Fault::Kind::kServerRestart : Fault::Kind::kPause, server ? "" : "trainer", 1400ms, 1500ms}};
    auto made = netsim::Simulation::make(setup);
    ASSERT_TRUE(made);
    Engagement hand;
    while ((*made)->now() < Time{} + 4800ms && (*made)->step())
      if ((*made)->now() > Time{} + 1410ms) hand.look(**made, 0, 0);
    ASSERT_EQ(hand.count, 1) << offset;
    EXPECT_LE(hand.first, kFirst) << offset;
    EXPECT_LE(hand.beyond, kBeyond) << offset;
    EXPECT_LE(hand.injected, kInjected) << offset;
    EXPECT_TRUE((*made)->violations().passed());
  }
}

}  // namespace
}  // namespace tandem
