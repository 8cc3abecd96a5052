#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/io/parallel_jobs.h"
#include "netsim/feel/feel_report.h"

namespace tandem::netsim {

struct FeelOptions {
  std::uint64_t first = 1, seeds = 20;
  std::vector<Probe> probes;
  std::size_t jobs = 0;  ///< 0: one per core
  int stop_fd = -1;      ///< as in io::JobOptions
  std::function<void(const io::JobProgress&)> on_progress = {};
};

/// Runs every probe with every seed, in parallel, and writes numbers, failures and times to `report`. The numbers do
/// not depend on `jobs`.
void measure_feel(const FeelSetup& setup, const FeelOptions& options, FeelReport& report);

}  // namespace tandem::netsim
