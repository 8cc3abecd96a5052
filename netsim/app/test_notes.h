#pragma once

#include <string>

#include "netsim/app/test_run.h"

namespace tandem::netsim {

/// Returns the notes of a scenario's seeds (SeedOutcome::notes), one line per kind of note: `  note: the outage at 90 s
/// came after ... (seed 3; seeds 4, 5 say alike)`. Empty if there are none.
[[nodiscard]] std::string notes_text(const ScenarioResult& result);

}  // namespace tandem::netsim
