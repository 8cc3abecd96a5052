#pragma once

#include <expected>

#include "netsim/demo/app/raw_run.h"
#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Runs in virtual time, in this process. The result equals that of `tandem-netsim run` with the same scene, network
/// and seed, byte for byte.
/// @return report and trace, or the error
[[nodiscard]] std::expected<RawRun, std::string> quick_run(const RunPlan& plan, const RunObserver& observer);

/// Returns the springs of the run's scene; unknown if the scene is not shipped.
[[nodiscard]] Springs springs_of(const RunPlan& plan);

}  // namespace tandem::netsim::demo
