#pragma once

#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Options of the demo.
struct DemoOptions {
  std::vector<const RunPlan*> runs;
  std::string out;       ///< output folder; empty: the report here, everything else in ./demo-output
  bool quick = false;    ///< virtual time
  bool keep = false;     ///< keep traces, reports and logs in ./demo-output
  bool console = false;  ///< start tandem-console beside the live runs
  std::string version;
  std::string repeat;  ///< command that repeats the demo, for the report
};

/// Runs the demo, prints the table and writes the report. @return the exit code of the program
[[nodiscard]] int run_demo(const DemoOptions& plan);

}  // namespace tandem::netsim::demo
