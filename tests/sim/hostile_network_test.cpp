// A switch that holds datagrams back, in a whole session in contact (tests/FAILURES.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kTrainer = 0;
constexpr Duration kAttack = 6s;
constexpr double kPressed = 0.5;  ///< least force on the block when the attack begins [N]

struct Held {
  Duration seen{};     ///< from the attack to the loss state
  double given_j = 0;  ///< largest energy that the motor gave the hand from the attack until the force was gone
  double tank_j = 0;
  bool active_meanwhile = false;  ///< active again while the arriving data is too old for any link
  bool active_after = false;      ///< active at the end, when the network delivers normally again
  std::uint32_t trips = 0;
  double pressed_n = 0;  ///< at the begin of the attack
};

/// Returns a scene in which the trainer presses the tool against the block. At the attack the trainer stops pressing
/// and moves along with the device. This is the worst moment, because only the gate keeps the spring from pushing the
/// hand away.
SceneSpec in_contact() {
  SceneSpec scene = test::set_position("contact");
  scene.duration = 20;
  scene.phases.clear();
  auto made = netsim::Simulation::make({.scene = scene});
  netsim::Simulation& rehearsal = **made;
  while (rehearsal.now() < Time{} + kAttack && rehearsal.step()) {
  }
  scene.seats[kTrainer].hand.until = rehearsal.session().clock().time();
  return scene;
}

Held attacked(const netsim::SimulationConfig& setup, Duration ends) {
  auto made = netsim::Simulation::make(setup);
  EXPECT_TRUE(made);
  netsim::Simulation& simulation = **made;
  Held out;
  double given = 0;
  hal::Vec3 before = hal::Vec3::Zero();
  while (simulation.step()) {
    const Duration into = simulation.now() - (Time{} + kAttack);
    const client::Seat* seat = simulation.seat(kTrainer);
    const hal::Vec3 x = simulation.device(kTrainer).ground_truth().x;
    if (into >= 0ms && out.seen == Duration{} && !seat->gate().active()) out.seen = into;
    if (into >= 0ms && into < 400ms) {
      given += simulation.device(kTrainer).state().f_out.dot(x - before);
      out.given_j = std::max(out.given_j, given);
    }
    if (into == 0ms) {
      EXPECT_TRUE(seat->gate().active());
      out.pressed_n = simulation.device(kTrainer).state().f_out.norm();
      EXPECT_GE(out.pressed_n, kPressed) << "no hand was in contact";
    }
    if (into > 400ms && into < ends) out.active_meanwhile |= seat->gate().active();
    if (into > 0ms && simulation.session().state() == wire::SessionState::kRunning)
      out.active_after = seat->gate().active();
    out.tank_j = seat != nullptr ? seat->gate().tank().size() : 0;
    before = x;
    if (into > ends + 3s) break;
  }
  out.trips = simulation.client(kTrainer).program().gate_trips();
  for (const auto& v : simulation.violations().list())
    EXPECT_TRUE(v.expected) << v.invariant << " " << v.seat << " at " << v.at_s;
  return out;
}

// "Hold-and-release: delay all FORCE by 25/100/1000/5000 ms in order: loss state within 20 ms of the limit; <= 20 mJ."
TEST(HostileNetwork, CausesALossButNoPushByDelayingAllForcesInOrder) {
  const SceneSpec scene = in_contact();
  for (const Duration delay : {Duration{25ms}, Duration{100ms}, Duration{1000ms}, Duration{5000ms}}) {
    SCOPED_TRACE(seconds(delay));
    netsim::SimulationConfig setup{.scene = scene};
    netsim::LinkSpec slow = setup.network;
    slow.down.floor = delay;
    netsim::NetworkEvent begins, ends;
    begins.at = kAttack;
    begins.direction = ends.direction = netsim::Direction::kDown;
    begins.link = slow;
    ends.at = kAttack + 8s;
    ends.link = setup.network;
    setup.events = {begins, ends};
    const Held held = attacked(setup, 8s);
    std::printf("[ hostile  ] held by %4.0f ms: %.2f N, loss state after %2.0f ms, %.2f mJ of %.0f\n",
                1e3 * seconds(delay), held.pressed_n, 1e3 * seconds(held.seen), 1e3 * held.given_j, 1e3 * held.tank_j);
    EXPECT_GT(held.seen, 0ms);
    EXPECT_LE(held.seen, from_seconds(scene.gate.silence_limit) + 20ms);
    EXPECT_LE(held.given_j, std::min(0.02, held.tank_j + 1e-6));
    // Above the largest loop age of any link, replayed data never moves the hand, at any regularity.
    if (delay > from_seconds(scene.gate.loop_age_max)) {
      EXPECT_FALSE(held.active_meanwhile);
    }
    EXPECT_EQ(held.trips, 1U);
  }
}

// The switch delivers all held datagrams at once: a burst of old forces, in order, all authentic.
TEST(HostileNetwork, MovesNothingByReleasingHeldForcesAtOnce) {
  const SceneSpec scene = in_contact();
  for (const Duration held_for : {Duration{25ms}, Duration{100ms}, Duration{1000ms}, Duration{5000ms}}) {
    SCOPED_TRACE(seconds(held_for));
    netsim::SimulationConfig setup{.scene = scene};
    netsim::OutageSpec outage;
    outage.start = kAttack;
    outage.length = held_for;
    outage.mode = netsim::OutageSpec::Mode::kHold;
    setup.network.down.outages = {outage};
    const Held held = attacked(setup, held_for);
    std::printf("[ hostile  ] released after %4.0f ms: %.2f N, loss state after %2.0f ms, %.2f mJ of %.0f\n",
                1e3 * seconds(held_for), held.pressed_n, 1e3 * seconds(held.seen), 1e3 * held.given_j,
                1e3 * held.tank_j);
    EXPECT_GT(held.seen, 0ms);
    EXPECT_LE(held.seen, from_seconds(scene.gate.silence_limit) + 20ms);
    EXPECT_LE(held.given_j, std::min(0.02, held.tank_j + 1e-6));
    EXPECT_FALSE(held.active_meanwhile);
    EXPECT_TRUE(held.active_after) << "an honest network is trusted again";
    EXPECT_EQ(held.trips, 1U);
  }
}

}  // namespace
}  // namespace tandem
