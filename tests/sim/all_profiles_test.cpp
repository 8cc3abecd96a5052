// Row "endpoint" of the validation matrix: one motion over every shipped network. The session generates no energy and
// keeps every invariant. It never reports a smaller gap, age or loss than the network has.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "hal/sim/recorded_motion.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/system/run_simulation.h"
#include "netsim/system/scene_run.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

/// Returns the motion of the shared recordings if they exist; otherwise a similar synthetic one.
std::shared_ptr<const hal::sim::RecordedMotion> motion() {
  std::stringstream text;
  const char* const folder = std::getenv("TANDEM_TRACES");
  std::ifstream file(std::string(folder == nullptr ? "" : folder) + "/motion_franka_teleop_follower_1khz_a.csv",
                     std::ios::binary);
  if (file) {
    text << file.rdbuf();
  } else {
    std::printf("[ NOT RUN  ] recorded motion through every profile: TANDEM_TRACES has none; a made-up one was used\n");
    text << "t_s[s],px_m[m],py_m[m],pz_m[m]\n";
    for (int k = 0; k < 9000; ++k) {
      const double t = 1e-3 * k;
      text << t << "," << 0.5 + 0.1 * std::sin(1.9 * t) << "," << -0.1 + 0.08 * std::sin(3.1 * t) << ","
           << 0.8 + 0.05 * std::sin(5.3 * t) << "\n";
    }
  }
  const auto options = hal::sim::parse_motion_options("motion.csv");
  auto parsed = hal::sim::RecordedMotion::parse(text.str(), *options, "motion.csv");
  if (!parsed) throw std::runtime_error(parsed.error());
  return std::make_shared<hal::sim::RecordedMotion>(std::move(*parsed));
}

/// Checks that the report of one direction is not better than the network.
void expect_true(const server::DirectionReport& told, const netsim::PathSpec& path, double duration_s) {
  const double floor_ms = 1e3 * seconds(path.floor);
  EXPECT_GE(told.age_p99_ms, floor_ms);
  EXPECT_GE(told.longest_gap_ms, 1 - 1e-6);
  EXPECT_GE(told.loss_percent, 0);
  EXPECT_LE(told.loss_percent, 100);
  if (path.loss.probability >= 0.01) {
    EXPECT_NEAR(told.loss_percent, 100 * path.loss.probability, 10 * std::sqrt(path.loss.probability))
        << "of some thousand datagrams";
  }
  const bool steady = path.body.kind == netsim::BodySpec::Kind::kNone && path.reorder.probability == 0 &&
                      path.boundary.period == Duration::zero();
  for (const netsim::OutageSpec& outage : path.outages) {  // a late datagram just before it would shorten the gap
    const bool met =
        steady && outage.mean_gap == Duration::zero() && seconds(outage.start + outage.length) < duration_s;
    if (met) {
      EXPECT_GE(told.longest_gap_ms, 1e3 * seconds(outage.length) - 1);
    }
  }
}

TEST(AllProfiles, KeepEverySessionPassiveAndMatchTheReportedLink) {
  const auto hand = motion();
  std::size_t ran = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    if (seed > test::count_factor()) break;
    for (const EmbeddedFile& shipped : netsim::complete_profiles()) {
      for (const bool recorded : {false, true}) {
        const netsim::SceneRun run{.scene = recorded ? "free_motion" : "contact",
                                   .profile = std::string(shipped.name),
                                   .seed = seed,
                                   .duration_s = recorded ? 6.0 : 12.0};
        SCOPED_TRACE(netsim::replay_command(run) + (recorded ? " --hand trainer=..." : ""));
        auto setup = netsim::simulation_config(run);
        ASSERT_TRUE(setup) << setup.error();
        for (const netsim::Direction direction : {netsim::Direction::kUp, netsim::Direction::kDown}) {
          netsim::RateSpec& rate = setup->network[direction].rate;
          if (!rate.recorded)
            continue;  // a capacity that the user supplies: 12 Mbit/s with a hole of 50 ms every second
          netsim::CapacityTrace capacity{{}, std::chrono::seconds(1)};
          for (std::int64_t ms = 0; ms < 950; ++ms) capacity.entries.push_back({ms, 1});
          rate.trace = std::make_shared<const netsim::CapacityTrace>(std::move(capacity));
        }
        if (recorded) setup->motions = {{"trainer", hand}};
        const netsim::SimulationResult result = netsim::run_simulation(*setup);
        ASSERT_EQ(result.trouble, "");
        const server::RunReport& report = result.report;
        ++ran;
        EXPECT_TRUE(report.passed);
        for (const server::Violation& v : report.violations)
          EXPECT_TRUE(v.expected) << v.invariant << " " << v.seat << " at " << v.at_s << " s";
        for (const server::SeatReport& seat : report.seats) {
          expect_true(seat.link.up, setup->network.up, run.duration_s);
          expect_true(seat.link.down, setup->network.down, run.duration_s);
          for (const double rtt_ms : {seat.link.rtt_p50_ms, seat.link.rtt_p99_ms})
            EXPECT_GE(rtt_ms, 1e3 * seconds(setup->network.up.floor + setup->network.down.floor));
        }
      }
    }
  }
  std::printf("[          ] %zu sessions\n", ran);
  EXPECT_GE(ran, 2 * netsim::complete_profiles().size());
}

}  // namespace
}  // namespace tandem
