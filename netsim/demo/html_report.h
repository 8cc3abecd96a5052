#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/demo/comparison.h"
#include "netsim/demo/run_numbers.h"

/// report.html: a single file without network requests. Its script only drives the animation. Pure functions.
namespace tandem::netsim::demo {

/// Machine and time of the runs.
struct RunInfo {
  bool real_time = false;  ///< processes over UDP; otherwise virtual time
  std::string date;        ///< "2026-11-21 10:30 UTC"
  std::string machine;     ///< "2 cores, Linux 6.1, x86_64"
  std::string version;
  std::string repeat;  ///< command that repeats the whole demo
};

[[nodiscard]] std::string html_report(std::span<const RunResult> runs, const Comparison& comparison,
                                      const RunInfo& where);

}  // namespace tandem::netsim::demo
