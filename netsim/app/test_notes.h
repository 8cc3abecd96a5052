#pragma once

#include <string>

#include "netsim/app/test_run.h"

namespace tandem::netsim {

/// What the seeds of a scenario have to say besides their verdicts (SeedOutcome::notes), one line for each kind of note:
/// `  note: the outage at 90 s came after ... (seed 3; seeds 4, 5 say alike)`. Empty when they say nothing.
[[nodiscard]] std::string notes_text(const ScenarioResult& result);

}  // namespace tandem::netsim
