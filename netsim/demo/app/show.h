#pragma once

#include <string>
#include <vector>

#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// What a person asked for.
struct ShowPlan {
  std::vector<const RunPlan*> runs;
  std::string out;     ///< empty: the report here, everything else in ./demo-output
  bool quick = false;  ///< virtual time
  bool keep = false;   ///< leave traces, reports and logs although no folder was named
  std::string version;
  std::string repeat;  ///< the command, for the report
};

/// Runs, prints the table, writes the report. @return the program's exit code
[[nodiscard]] int show(const ShowPlan& plan);

}  // namespace tandem::netsim::demo
