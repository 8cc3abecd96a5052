// Feel of hands whose clients shift their ticks, beside the same clients at phases that are drawn and kept. The
// same hands, networks, phases at the start and seeds. "Rested": the shifts were made long ago. Virtual time.
//   tick_phase_table [SEEDS]    default 20
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "netsim/feel/feel_keys.h"
#include "tests/sim/phase_cell.h"
#include "tests/support/simulation_run.h"

namespace {

using namespace tandem;
using namespace tandem::test;
using netsim::ClientPhases;

constexpr std::array kScenes{"contact_remote", "free_motion"};
constexpr std::array kDelaysMs{0.03, 0.3, 5.0, 5.3};
constexpr std::array kPhases{ClientPhases::kDrawn, ClientPhases::kRested, ClientPhases::kShifted};

struct Cell {
  std::size_t scene, delay;
  std::array<std::vector<netsim::FeelValues>, kPhases.size()> seeds;  ///< by phases and seed
};

struct Spread {
  double mean = 0, least = 1e300, most = -1e300;
  void add(double value, double of) {
    mean += value / of;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

void print_row(const Cell& cell, const netsim::FeelKey& key) {
  std::array<Spread, kPhases.size()> all;
  std::array<Spread, kPhases.size() - 1> change;
  const std::size_t seeds = cell.seeds[0].size();
  const auto n = static_cast<double>(seeds);
  for (std::size_t s = 0; s < seeds; ++s) {
    std::array<double, kPhases.size()> value;
    for (std::size_t p = 0; p < kPhases.size(); ++p) {
      value[p] = key.factor * cell.seeds[p][s].at(std::string(key.key));
      all[p].add(value[p], n);
    }
    for (std::size_t p = 0; p < change.size(); ++p) change[p].add(value[p + 1] - value[0], n);
  }
  std::printf("  %-42s", std::string(key.description).c_str());
  for (const Spread& s : all) std::printf("  %8.4g (%8.4g)", s.mean, key.least_is_worst ? s.least : s.most);
  for (const Spread& s : change) std::printf("  %+8.2g (%+8.2g)", s.mean, key.least_is_worst ? s.least : s.most);
  std::printf(" %s\n", std::string(key.unit).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t seeds = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20;
  std::vector<Cell> cells;
  for (std::size_t scene = 0; scene < kScenes.size(); ++scene)
    for (std::size_t delay = 0; delay < kDelaysMs.size(); ++delay) {
      cells.push_back({scene, delay, {}});
      for (auto& of : cells.back().seeds) of.resize(seeds);
    }
  std::atomic<std::size_t> next = 0;
  const std::size_t per_cell = kPhases.size() * seeds;
  const auto work = [&] {
    for (std::size_t i = next++; i < cells.size() * per_cell; i = next++) {
      Cell& cell = cells[i / per_cell];
      const std::size_t p = i % per_cell / seeds, s = i % seeds;
      cell.seeds[p][s] = felt(shipped(kScenes[cell.scene]), kDelaysMs[cell.delay], kPhases[p], s + 1);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  }
  for (const Cell& cell : cells) {
    std::printf("%s, %g ms one way, %zu seeds: mean (worst)\n  %-42s  %-19s  %-19s  %-19s  %-19s  %s\n",
                kScenes[cell.scene], kDelaysMs[cell.delay], seeds, "", "drawn", "rested", "shifted at the start",
                "rested - drawn", "shifted - drawn");
    for (const netsim::FeelKey& key : kPhaseKeys) print_row(cell, key);
  }
  return 0;
}
