#pragma once

#include <vector>

#include "netsim/quality/quality_text.h"
#include "netsim/system/simulation.h"

namespace tandem::netsim {

/// Returns the link quality of every seat during the session, in the order of the scene. Empty unless the setup
/// requested it (`monitor_quality`) and the session began.
[[nodiscard]] std::vector<NamedLink> link_qualities(const Simulation& simulation);

}  // namespace tandem::netsim
