#pragma once

#include <expected>

#include "netsim/demo/app/raw_run.h"
#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// The run in virtual time, in this process: byte for byte what `tandem-netsim run` makes of the same scene, network
/// and seed.
/// @return report and trace, or why not
[[nodiscard]] std::expected<RawRun, std::string> quick_run(const RunPlan& plan, const RunWatch& watch);

/// The springs of the run's scene; unknown if it is not shipped.
[[nodiscard]] Springs springs_of(const RunPlan& plan);

}  // namespace tandem::netsim::demo
