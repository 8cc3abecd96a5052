// Measures the cost of a scene in virtual time, per tick and as a multiple of real time. The reference is the smallest
// scene in the same run.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "common/transport/digest.h"
#include "server/report/trace_csv.h"
#include "tests/support/alloc_guard.h"
#include "tests/support/simulation_run.h"

namespace {

using namespace tandem;

struct Cost {
  double us_per_tick = 0;
  double allocations_per_tick = 0;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Measures the CPU time of `ticks` ticks, after 2000 ticks of settling.
/// @param traced  true: with trace and hash, as `tandem-netsim run`; false: invariants only, as the swarm
Cost measure(const std::string& name, const netsim::SimpleNetwork& net, int ticks, bool traced) {
  netsim::SimulationConfig setup{.scene = test::shipped(name), .network = netsim::link_from(net)};
  setup.keep_record = traced;
  auto simulation = std::move(*netsim::Simulation::make(setup));
  const server::TraceCsv csv{simulation->scene()};
  transport::Digest digest;
  std::string row;
  row.reserve(1 << 16);
  for (int k = 0; k < 2000; ++k) simulation->step();
  test::AllocGuard guard;
  const double begin = cpu_seconds();
  for (int k = 0; k < ticks; ++k) {
    simulation->step();
    if (!traced) continue;
    row.clear();
    csv.append(simulation->record(), row);
    digest.add(row);
  }
  return {1e6 * (cpu_seconds() - begin) / ticks, static_cast<double>(guard.count()) / ticks};
}

}  // namespace

int main() {
  struct Case {
    const char* scene;
    double delay_ms, jitter_ms, loss;
    bool traced = true;
  };
  const std::vector<Case> cases{{"one_axis", 0, 0, 0},           {"free_motion", 0, 0, 0},
                                {"free_motion", 20, 5, 5},       {"contact", 0, 0, 0},
                                {"contact_remote", 0, 0, 0},     {"seed_free_motion", 0, 0, 0},
                                {"two_by_two", 0, 0, 0},         {"eight_seats", 0, 0, 0},
                                {"free_motion", 0, 0, 0, false}, {"free_motion", 20, 5, 5, false},
                                {"eight_seats", 0, 0, 0, false}};
  constexpr int kRounds = 5, kTicks = 4000;
  std::vector<std::vector<Cost>> costs(cases.size());
  for (int round = 0; round < kRounds; ++round)  // interleaved, so that a disturbance affects all cases
    for (std::size_t i = 0; i < cases.size(); ++i)
      costs[i].push_back(measure(cases[i].scene, test::delayed(cases[i].delay_ms, cases[i].jitter_ms, cases[i].loss),
                                 kTicks, cases[i].traced));
  const auto median = [](std::vector<Cost> c) {
    std::ranges::sort(c, {}, &Cost::us_per_tick);
    return c[c.size() / 2];
  };
  const double reference = median(costs[0]).us_per_tick;
  std::printf("%-18s %-22s %-7s %12s %18s %14s %12s\n", "scene", "network", "trace", "us per tick", "x real time",
              "x one_axis", "heap/tick");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Cost m = median(costs[i]);
    char network[64];
    std::snprintf(network, sizeof network, "%.0f + %.0f ms, %.0f %%", cases[i].delay_ms, cases[i].jitter_ms,
                  cases[i].loss);
    std::printf("%-18s %-22s %-7s %12.2f %18.0f %14.2f %12.4f\n", cases[i].scene, network,
                cases[i].traced ? "yes" : "no", m.us_per_tick, 1000.0 / m.us_per_tick, m.us_per_tick / reference,
                m.allocations_per_tick);
  }
  std::printf(
      "median of %d interleaved rounds of %d ticks; CPU time of this process; trace: with rows and SHA-256, else "
      "invariants only, as in the swarm\n",
      kRounds, kTicks);
  return 0;
}
