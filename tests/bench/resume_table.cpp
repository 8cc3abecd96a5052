// Forces on hands and their distances to the tool after a restart of the server, beside the same sessions without it.
// Virtual time.
//   resume_table [SEEDS [LAW]]    default 20 replica; LAW: replica or set_position
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tests/sim/resume_cell.h"

namespace {

using namespace tandem;
using namespace tandem::test;

constexpr std::array kDelaysMs{0.3, 5.0, 20.0};

struct Cell {
  Moving moving;
  double delay;
  std::vector<Resumed> with, without;  ///< by seed
};

struct Spread {
  double mean = 0, worst = 0;
};

template <typename Value>
Spread spread(const std::vector<Resumed>& runs, const Value& value) {
  Spread out;
  for (const Resumed& run : runs) {
    out.mean += value(run) / static_cast<double>(runs.size());
    out.worst = std::max(out.worst, value(run));
  }
  return out;
}

template <typename Value>
void print_row(const Cell& cell, const char* name, const char* unit, double factor, const Value& value) {
  const Spread with = spread(cell.with, value), without = spread(cell.without, value);
  std::printf("  %-46s %8.4g (%8.4g)   %8.4g (%8.4g) %s\n", name, factor * with.mean, factor * with.worst,
              factor * without.mean, factor * without.worst, unit);
}

void print(const Cell& cell) {
  std::printf("%s, %g ms one way, %zu seeds: mean (worst)     restart               without\n",
              kMovingNames[static_cast<std::size_t>(cell.moving)], cell.delay, cell.with.size());
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string hand = i == 0 ? "leader, " : "follower, ";
    const auto row = [&](const char* name, const char* unit, double factor, double ResumedHand::* value) {
      print_row(cell, (hand + name).c_str(), unit, factor, [&](const Resumed& run) { return run.hands[i].*value; });
    };
    row("force in the first tick", "N", 1, &ResumedHand::first);
    row("largest force", "N", 1, &ResumedHand::force);
    row("RMS of force, 2 s", "N", 1, &ResumedHand::force_rms);
    row("largest step of force", "N/ms", 1, &ResumedHand::step);
    row("distance to the tool at engagement", "mm", 1e3, &ResumedHand::begin);
    row("largest distance to the tool", "mm", 1e3, &ResumedHand::distance);
    row("  from 2 s on", "mm", 1e3, &ResumedHand::after_2);
    row("  from 4 s on", "mm", 1e3, &ResumedHand::after_4);
    row("  within 5 mm after", "s", 1, &ResumedHand::back);
  }
  print_row(cell, "tool, largest speed", "m/s", 1, [](const Resumed& run) { return run.tool_speed; });
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t seeds = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20;
  const LawKind law = argc > 2 && std::string(argv[2]) == "set_position" ? LawKind::kSetPosition : LawKind::kReplica;
  std::vector<Cell> cells;
  for (std::size_t m = 0; m < kMovingNames.size(); ++m)
    for (const double delay : kDelaysMs)
      cells.push_back({static_cast<Moving>(m), delay, std::vector<Resumed>(seeds), std::vector<Resumed>(seeds)});
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < cells.size() * seeds; i = next++) {
      Cell& cell = cells[i / seeds];
      const std::size_t s = i % seeds;
      const ResumeCase run{law, cell.moving, cell.delay, s + 1};
      cell.with[s] = resumed(run);
      cell.without[s] = undisturbed(run, cell.with[s]);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  }
  for (const Cell& cell : cells) print(cell);
  return 0;
}
