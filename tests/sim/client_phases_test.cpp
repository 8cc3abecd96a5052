// Phases of the clients' ticks within the server's tick: the loop that they give, and what a hand feels.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "netsim/system/simulation.h"
#include "tests/sim/phase_cell.h"
#include "tests/support/simulation_run.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using netsim::ClientPhases;

constexpr Duration kTick = 1ms;

struct Loop {
  double ticks = 0;          ///< from sending a STATE to the tick that uses the FORCE that answers it, mean
  double most = 0;           ///< the longest of them
  double waited = 0;         ///< time for which the STATEs had waited for the server's tick, mean [ticks]
  double age = 0;            ///< of the FORCEs in the client's ticks, as the client estimates it, mean [ticks]
  double age_at_server = 0;  ///< of the STATEs in the server's ticks, as the server estimates it, mean [ticks]
};

/// Runs free motion and returns the loop of the leading hand in the third second.
/// @param phase  of all clients' ticks after the server's, at the start
Loop loop_at(Duration phase, Duration one_way, bool shifts) {
  netsim::SimulationConfig config{.scene = shipped("free_motion")};
  config.scene.duration = 3;
  config.network.up.floor = config.network.down.floor = one_way;
  for (const SeatSpec& seat : config.scene.seats)
    config.endpoints[seat.name].wake = {.kind = netsim::WakeSpec::Kind::kUniform, .phase = phase, .shifts = shifts};
  auto made = netsim::Simulation::make(config);
  EXPECT_TRUE(made);
  Loop loop;
  int count = 0;
  while ((*made)->step()) {
    if ((*made)->session().clock().time() < 2 || (*made)->session().clock().time() > 2.99) continue;
    const netsim::SimulatedClient& client = (*made)->client(0);
    const transport::LinkTiming& timing = client.seat()->link().timing();
    const double ticks = seconds(timing.loop_age(client.own_time(client.last_run()))) / seconds(kTick);
    loop.ticks += ticks;
    loop.most = std::max(loop.most, ticks);
    loop.waited += seconds(timing.peer_silence()) / seconds(kTick);
    loop.age += seconds(timing.age(client.own_time(client.last_run()))) / seconds(kTick);
    loop.age_at_server += (*made)->session().seat(0).age() / seconds(kTick);
    ++count;
  }
  loop.ticks /= count;
  loop.waited /= count;
  loop.age /= count;
  loop.age_at_server /= count;
  EXPECT_GT(count, 900);
  return loop;
}

/// A STATE is sent at phase p and used at the server's tick ceil(p + d). The FORCE arrives d later, and the client's
/// first tick from then on uses it.
double loop_by_hand(double p, double d) { return std::ceil(std::ceil(p + d) + d - p); }

TEST(ClientPhases, GiveTheLoopComputedByHand) {
  for (const Duration one_way : {30us, 300us, 480us, 5000us, 5300us})
    for (const Duration phase : {10us, 150us, 350us, 550us, 750us, 900us, 990us}) {
      SCOPED_TRACE(std::to_string(one_way / 1us) + " us, phase " + std::to_string(phase / 1us) + " us");
      const Loop loop = loop_at(phase, one_way, false);
      const double p = seconds(phase) / seconds(kTick), d = seconds(one_way) / seconds(kTick);
      EXPECT_NEAR(loop.ticks, loop_by_hand(p, d), 1e-6);
      EXPECT_NEAR(loop.waited, std::ceil(p + d) - p - d, 1e-6);
      EXPECT_NEAR(loop.age, loop.ticks / 2, 1e-3) << "messages state ages in microseconds";
      EXPECT_NEAR(loop.age_at_server, loop.ticks / 2, 1e-3);
    }
}

/// The wait that clients aim at is a sixth of a tick, and they rest within 0.05 ticks of it.
TEST(ClientPhases, ThatAreShiftedGiveTheShortestLoopFromEveryStart) {
  for (const Duration one_way : {30us, 300us, 5000us, 5300us})
    for (const Duration phase : {10us, 150us, 350us, 550us, 750us, 900us, 990us}) {
      SCOPED_TRACE(std::to_string(one_way / 1us) + " us, phase " + std::to_string(phase / 1us) + " us");
      const Loop loop = loop_at(phase, one_way, true);
      const double d = seconds(one_way) / seconds(kTick);
      EXPECT_NEAR(loop.waited, 1.0 / 6, 0.051);
      EXPECT_NEAR(loop.age, loop.ticks / 2, 1e-3) << "a second after the shift";
      EXPECT_NEAR(loop.age_at_server, loop.ticks / 2, 1e-3);
      EXPECT_NEAR(loop.ticks, std::ceil(2 * d + 1.0 / 6), 1e-3);
      double least = 1e9;
      for (double p = 0.005; p < 1; p += 0.01) least = std::min(least, loop_by_hand(p, d));
      EXPECT_NEAR(loop.ticks, least, 1e-3);
    }
}

/// Twice 480 us and a sixth of a tick are more than one tick: the FORCE arrives just after the client's tick.
TEST(ClientPhases, ThatAreShiftedHaveOneTickMoreThanTheBestPhaseIfTheDelaysLeaveLessThanTheirWait) {
  EXPECT_NEAR(loop_at(500us, 480us, false).ticks, 1, 1e-3);
  EXPECT_NEAR(loop_at(500us, 480us, true).ticks, 2, 1e-3);
  int longer = 0;
  for (double p = 0.005; p < 1; p += 0.01) longer += loop_by_hand(p, 0.48) > 1 ? 1 : 0;
  EXPECT_EQ(longer, 96) << "as at nearly all phases";
}

/// The table of 20 seeds is in ARCHITECTURE.md, "Order within a tick".
TEST(ClientPhases, AtRestCostNoDragAndAtMostThreePercentOfTheStiffness) {
  constexpr std::uint64_t kSeeds = 2;
  for (const double one_way_ms : {0.03, 5.0}) {
    SCOPED_TRACE(one_way_ms);
    std::map<std::string, double> drawn, rested;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      for (const auto& [key, value] : felt(shipped("contact_remote"), one_way_ms, ClientPhases::kDrawn, seed))
        drawn[key] += value / kSeeds;
      for (const auto& [key, value] : felt(shipped("contact_remote"), one_way_ms, ClientPhases::kRested, seed))
        rested[key] += value / kSeeds;
    }
    EXPECT_LE(rested["loop_s"], drawn["loop_s"] + 1e-9);
    EXPECT_LE(rested["drag_05hz_n"], drawn["drag_05hz_n"] + 1e-3);
    EXPECT_LE(rested["drag_05hz_n_s_m"], drawn["drag_05hz_n_s_m"] + 0.01);
    EXPECT_GE(rested["stiffness_felt_n_m"], 0.97 * drawn["stiffness_felt_n_m"]);
    EXPECT_GE(rested["stiffness_bone_held_n_m"], 0.97 * drawn["stiffness_bone_held_n_m"]);
    EXPECT_LE(rested["overshoot"], drawn["overshoot"] + 0.05) << "less damping lets the tool swing further";
    EXPECT_LE(rested["limit_cycle_n"], 0.02);
  }
}

}  // namespace
}  // namespace tandem::test
