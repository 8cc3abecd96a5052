// Sessions whose ends hold datagrams back (scene { send { } }): the datagrams that it saves, the feel that it keeps,
// and the estimates of the link, which count no held datagram as lost.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "netsim/feel/feel_keys.h"
#include "netsim/feel/feel_summary.h"
#include "netsim/feel/probes.h"
#include "tests/common/base/counts.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

SceneSpec with_dead_band(SceneSpec scene) {
  scene.send.dead_band.emplace();
  return scene;
}
/// Law SET_POSITION with a tolerated silence of 60 ms, thus a heartbeat of 10 ms.
SceneSpec set_position_with_dead_band(const std::string& name) {
  SceneSpec scene = with_dead_band(test::set_position(name));
  scene.gate.silence_limit = 0.06;
  return scene;
}

struct Counted {
  test::RunResult run;
  double up = 0, down = 0;  ///< datagrams of all masters per tick in which they were engaged
  double loss_percent = 0;  ///< worst direction of any seat
  double ticks = 0;         ///< of all masters in which they were engaged
  double rtt_ms = 0;        ///< median of the first seat
  std::uint64_t trips = 0;
};
Counted counted(const SceneSpec& scene, const netsim::SimpleNetwork& net, std::uint64_t seed = 1) {
  Counted out;
  double& ticks = out.ticks;
  std::vector<std::uint64_t> up(scene.masters()), down(scene.masters());
  out.run = test::run(scene, net, seed, [&](netsim::Simulation& s) {
    out.trips = 0;
    for (std::size_t i = 0; i < scene.masters(); ++i) {
      if (s.seat(i) == nullptr || s.session().seat(i).link() == nullptr) continue;
      const auto &client = s.seat(i)->link().stats(), &server = s.session().seat(i).link()->stats();
      const bool same = client.sent >= up[i] && server.sent >= down[i];  // statistics restart when the session runs
      if (s.seat(i)->gate().active() && up[i] > 0 && same) {
        out.up += static_cast<double>(client.sent - up[i]);
        out.down += static_cast<double>(server.sent - down[i]);
        ++ticks;
      }
      up[i] = client.sent;
      down[i] = server.sent;
      out.loss_percent = std::max({out.loss_percent, client.loss_percent(), server.loss_percent()});
      out.trips += s.client(i).program().gate_trips();
    }
    if (s.seat(0) != nullptr) out.rtt_ms = 1e3 * seconds(s.seat(0)->link().timing().rtt_p50());
  });
  out.up /= ticks;
  out.down /= ticks;
  return out;
}

TEST(DeadBand, SavesDatagramsWithoutLossTripsOrViolations) {
  for (const std::string name : {"free_motion", "contact", "two_by_two", "lesson", "contact_remote"})
    for (const bool replica : {true, false}) {
      SCOPED_TRACE(name + (replica ? ", replica" : ", set_position"));
      SceneSpec scene = replica ? with_dead_band(test::shipped(name)) : set_position_with_dead_band(name);
      scene.duration = std::min(scene.duration, 12.0);
      std::erase_if(scene.timeline, [&](const TimedAuthority& t) { return t.at >= scene.duration; });
      scene.phases.clear();
      SceneSpec full = scene;
      full.send = {};
      for (const double delay : {0.0, 50.0}) {
        const Counted c = counted(scene, test::delayed(delay)), all = counted(full, test::delayed(delay));
        std::printf("[dead-band] %-28s %3.0f ms: up %5.1f %%, down %5.1f %%\n",
                    (name + (replica ? ", replica" : ", set_position")).c_str(), delay, 100 * c.up, 100 * c.down);
        EXPECT_EQ(c.run.trouble, "");
        EXPECT_TRUE(c.run.report.violations.empty()) << c.run.report.violations[0].invariant;
        EXPECT_NEAR(all.up, 1, 0.01);
        EXPECT_LT(c.up, 0.5);
        EXPECT_LT(c.down, 0.5);
        EXPECT_EQ(c.loss_percent, 0) << "a datagram that was not sent is no loss";
        EXPECT_NEAR(c.rtt_ms, all.rtt_ms, 1.01) << "nor does it make the round trip longer";
        EXPECT_LE(c.trips, all.trips);
        EXPECT_NEAR(c.ticks, all.ticks, 0.01 * all.ticks) << "seats are engaged as long as without";
      }
    }
}

// A link on which datagrams are held back is not stale: authority moves to and from hands at rest as it does without.
TEST(DeadBand, MovesAuthorityBetweenHandsAtRestAsWithout) {
  for (const double silence_limit : {0.01, 0.02})
    for (const netsim::SimpleNetwork& net : {test::delayed(0), test::delayed(10, 5, 5)}) {
      SCOPED_TRACE(silence_limit);
      SceneSpec scene = test::shipped("free_motion");
      scene.gate.silence_limit = silence_limit;
      scene.phases.clear();
      scene.timeline.clear();
      for (SeatSpec& seat : scene.seats) {
        seat.hand = {};
        seat.hand.model = HandModel::kResting;
      }
      for (int i = 0; i < 20; ++i) scene.timeline.push_back({.at = 3 + 0.5 * i, .row = {}});
      for (std::size_t i = 0; i < 20; ++i)
        scene.timeline[i].row = {.alpha = {i % 2 == 0 ? 0.0 : 1.0, i % 2 == 0 ? 1.0 : 0.0}};
      scene.duration = 14;
      double led[2] = {0, 0};  // ticks in which the first hand has authority
      for (const bool held : {false, true})
        static_cast<void>(test::run(held ? with_dead_band(scene) : scene, net, 1, [&](netsim::Simulation& s) {
          led[held] += s.session().tool(0).authority.requested()[0];
        }));
      EXPECT_GT(led[0], 5000);
      // A bad network defers some changes by 50 ticks each, with and without a dead-band.
      EXPECT_NEAR(led[1], led[0], net.loss > 0 ? 150 : 2);
    }
}

TEST(DeadBand, HoldsOnNetworksThatLoseAndDelay) {
  netsim::SimpleNetwork bad = test::delayed(30, 15, 5);
  for (std::uint64_t seed = 1, last = test::seeds(3); seed <= last; ++seed)
    for (const netsim::SimpleNetwork& net : {bad, test::with_outages(test::delayed(20), 0.3, 3)}) {
      SCOPED_TRACE(seed);
      for (const SceneSpec& scene :
           {with_dead_band(test::shipped("free_motion")), set_position_with_dead_band("contact")}) {
        SceneSpec full = scene;
        full.send = {};
        const Counted c = counted(scene, net, seed), all = counted(full, net, seed);
        EXPECT_TRUE(c.run.report.violations.empty()) << c.run.report.violations[0].invariant;
        EXPECT_LE(c.trips, all.trips + 2) << "a heartbeat may be lost more often than six datagrams in a row";
      }
    }
}

/// The figure of the literature: some 90 % of the datagrams, at the same feel.
TEST(DeadBand, SavesNineTenthsAtEqualFeel) {
  netsim::FeelSetup setup{.scene = test::shipped("contact")};
  setup.network = netsim::link_from(test::delayed(20));
  netsim::FeelSetup held = setup;
  held.scene.send.dead_band.emplace();
  const std::uint64_t last = test::seeds(3);
  std::vector<netsim::FeelSeed> before, after;
  for (std::uint64_t seed = 1; seed <= last; ++seed)
    for (const auto& [what, into] : {std::pair{&setup, &before}, std::pair{&held, &after}}) {
      netsim::FeelSeed one{.seed = seed, .values = {}};
      netsim::Exposure exposure;
      for (const netsim::Probe probe : {netsim::Probe::kPress, netsim::Probe::kFree}) {
        const netsim::ProbeResult result = netsim::run_probe(probe, *what, seed);
        ASSERT_EQ(result.trouble, "");
        one.values.insert(result.values.begin(), result.values.end());
        exposure.add(result.exposure);
      }
      netsim::put_exposure(exposure, one.values);
      into->push_back(std::move(one));
    }
  const auto full = netsim::summarised(before), saved = netsim::summarised(after);
  EXPECT_FALSE(full.contains("sent_up_share"));
  EXPECT_LT(0.5 * (saved.at("sent_up_share").mean + saved.at("sent_down_share").mean), 0.12);
  for (const char* key : {"stiffness_felt_n_m", "stiffness_tissue_n_m", "force_share", "drag_05hz_n", "drag_1hz_n",
                          "follower_force_05hz_n", "follower_force_1hz_n"})
    EXPECT_NEAR(saved.at(key).mean, full.at(key).mean, 0.07 * full.at(key).mean)
        << key << ": 7 % of a force is one just-noticeable difference";
  EXPECT_NEAR(saved.at("leader_tool_05hz_m").mean, full.at("leader_tool_05hz_m").mean, 0.0005);
  EXPECT_EQ(saved.at("trips_per_min").worst, 0);
}

/// Requests and session states do not wait for a heartbeat: with and without a dead-band the same ticks carry them.
TEST(DeadBand, DelaysNoStop) {
  std::uint32_t stopped_at[2] = {0, 0};
  for (const bool held : {false, true}) {
    netsim::SimulationConfig config{.scene = test::shipped("free_motion"),
                                    .network = netsim::link_from(test::delayed(20))};
    if (held) config.scene = with_dead_band(config.scene);
    auto simulation = netsim::Simulation::make(config);
    ASSERT_TRUE(simulation);
    std::uint32_t tick = 0;
    while ((*simulation)->step() && ++tick < 8000 && stopped_at[held] == 0) {
      client::Seat* const seat = (*simulation)->seat(0);
      if (tick == 5000) {
        ASSERT_TRUE(seat != nullptr && seat->gate().active());
        EXPECT_TRUE(seat->requests().stop_all());
      }
      if (tick > 5000 && (*simulation)->seat(1)->force().session == wire::SessionState::kStopped)
        stopped_at[held] = tick;
    }
  }
  EXPECT_GT(stopped_at[0], 5000u);
  EXPECT_EQ(stopped_at[1], stopped_at[0]);
}

}  // namespace
}  // namespace tandem
