// Compares the default with the couplings of shared haptic environments, for 2 to 8 hands over a one-way delay of 0 to
// 500 ms: whole sessions, drawn hands, two free motions, a press on bone and a kick. Cells in which the default is
// worse by more than a tenth are named.
//   coupling_table [SEEDS]    default 20: some 20 minutes of processor time, shared by all cores
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "tests/sim/coupling_cell.h"

namespace {

using namespace tandem::test;

constexpr Contender kContenders[] = {kDefault, kPeer, kAverage};
constexpr std::size_t kHands[] = {2, 3, 4, 6, 8};
constexpr double kDelays[] = {0, 20, 100, 200, 500};

struct Job {
  std::size_t hands;
  double delay_ms;
  Cell cells[std::size(kContenders)];
};

}  // namespace

int main(int count, char** arguments) {
  const std::uint64_t seeds = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 20;
  std::vector<Job> jobs;
  for (const std::size_t hands : kHands)
    for (const double delay_ms : kDelays) jobs.push_back({hands, delay_ms, {}});
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size() * std::size(kContenders); i = next++) {
      Job& job = jobs[jobs.size() - 1 - i / std::size(kContenders)];
      const std::size_t who = i % std::size(kContenders);
      job.cells[who] = average_cell(kContenders[who], job.hands, job.delay_ms, seeds);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  }
  std::printf("mean over %llu seeds; %s / %s / %s\n", static_cast<unsigned long long>(seeds), kDefault.name.data(),
              kPeer.name.data(), kAverage.name.data());
  std::printf("%5s %6s", "hands", "delay");
  for (const Measure& m : kMeasures)
    std::printf("  %-20s", (std::string(m.name) + " [" + std::string(m.unit) + "]").c_str());
  std::printf("\n");
  std::map<std::string, std::string> lost;  // hands, by measure, delay and contender
  for (const Job& job : jobs) {
    std::printf("%5zu %6.0f", job.hands, job.delay_ms);
    for (const Measure& m : kMeasures) {
      char text[64];
      std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g", m.scale * job.cells[0].*m.value,
                    m.scale * job.cells[1].*m.value, m.scale * job.cells[2].*m.value);
      std::printf("  %-20s", text);
      for (std::size_t who = 1; who < std::size(kContenders); ++who)
        if (loses(m, job.cells[0], job.cells[who]))
          lost[std::string(m.name) + " at " + std::to_string(static_cast<int>(job.delay_ms)) + " ms against " +
               std::string(kContenders[who].name)] += " " + std::to_string(job.hands);
    }
    std::printf("\n");
  }
  std::printf("the default is worse by more than a tenth in%s\n", lost.empty() ? " no cell" : ":");
  for (const auto& [where, hands] : lost) std::printf("  %s, hands:%s\n", where.c_str(), hands.c_str());
  return 0;
}
