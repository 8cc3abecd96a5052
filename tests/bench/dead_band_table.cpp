// Datagrams saved by the perceptual dead-band, and what it costs in feel: the same hands, networks and seeds with each
// setting. The table is the basis of the defaults of `send` (server/README.md).
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "netsim/feel/feel_keys.h"
#include "netsim/feel/feel_summary.h"
#include "netsim/feel/probes.h"
#include "tests/support/simulation_run.h"

namespace {

using namespace tandem;
using namespace tandem::netsim;

/// A row of the table; weber 0: a datagram at every tick.
struct Setting {
  double weber, velocity_floor, force_floor;
  std::uint32_t order;
};

struct Column {
  const char *key, *title;
  double per_si;
};
constexpr std::array kColumns{Column{"sent_up_share", "up %", 100},
                              Column{"sent_down_share", "down %", 100},
                              Column{"stiffness_felt_n_m", "bone N/m", 1},
                              Column{"force_share", "force %", 100},
                              Column{"drag_1hz_n", "drag N", 1},
                              Column{"leader_tool_05hz_m", "lead .5 mm", 1e3},
                              Column{"leader_tool_1hz_m", "lead 1 mm", 1e3},
                              Column{"leader_tool_step_m", "step mm", 1e3},
                              Column{"follower_tool_05hz_m", "follow mm", 1e3},
                              Column{"follower_force_05hz_n", "f.force N", 1},
                              Column{"follower_step_05hz_n_ms", "f.step", 1},
                              Column{"handover_bump_n", "bump N", 1},
                              Column{"shared_cycle_n", "cycle N", 1},
                              Column{"trips_per_min", "trips/min", 1}};

std::map<std::string, FeelNumber> measured(const SceneSpec& scene, double delay_ms, std::uint64_t seeds) {
  FeelSetup setup{.scene = scene};
  setup.network = link_from(test::delayed(delay_ms));
  std::vector<FeelSeed> all;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    FeelSeed one{.seed = seed, .values = {}};
    Exposure exposure;
    for (const Probe probe : {Probe::kPress, Probe::kFree, Probe::kHandOver, Probe::kShare}) {
      const ProbeResult result = run_probe(probe, setup, seed);
      if (!result.trouble.empty())
        std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), result.trouble.c_str());
      one.values.insert(result.values.begin(), result.values.end());
      exposure.add(result.exposure);
    }
    put_exposure(exposure, one.values);
    all.push_back(std::move(one));
  }
  return summarised(all);
}

}  // namespace

/// dead_band_table [SEEDS [DELAY_MS]]
int main(int argc, char** argv) {
  const auto seeds = static_cast<std::uint64_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  std::vector<double> delays{0, 50};
  if (argc > 2) delays = {std::atof(argv[2])};
  const DeadBandSpec band;
  std::vector<Setting> settings{{0, 0, 0, 1}};
  for (const double weber : {0.02, 0.05, 0.1, 0.15, 0.2, 0.3})
    settings.push_back({weber, band.velocity_floor, band.force_floor, 1});
  settings.push_back({0.1, band.velocity_floor, band.force_floor, 0});
  settings.push_back({0.3, band.velocity_floor, band.force_floor, 0});
  for (const double delay : delays) {
    std::printf("scene contact, %.0f ms one way, %llu seeds: mean (worst)\n%-24s", delay,
                static_cast<unsigned long long>(seeds), "weber, floors, order");
    for (const Column& column : kColumns) std::printf(" %14s", column.title);
    std::printf("\n");
    for (const Setting& setting : settings) {
      SceneSpec scene = test::shipped("contact");
      if (setting.weber > 0) {
        scene.send.dead_band = DeadBandSpec{setting.weber, setting.velocity_floor, setting.force_floor};
        scene.send.prediction_order = setting.order;
      }
      const auto numbers = measured(scene, delay, seeds);
      if (setting.weber > 0) {
        std::printf("%4.2f  %.3g %.3g  order %u   ", setting.weber, setting.velocity_floor, setting.force_floor,
                    setting.order);
      } else {
        std::printf("%-24s", "every tick");
      }
      for (const Column& column : kColumns) {
        const auto found = numbers.find(column.key);
        if (found == numbers.end()) {
          std::printf(" %14s", "100");
        } else {
          std::printf(" %6.3g (%5.3g)", found->second.mean * column.per_si, found->second.worst * column.per_si);
        }
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  return 0;
}
