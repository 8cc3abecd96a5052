#pragma once

#include <vector>

#include "netsim/quality_text.h"
#include "netsim/world.h"

namespace tandem::netsim {

/// What every seat's link was like while the session ran, in the order of the scene; empty unless the setup asked for it
/// (`watch_quality`) and the session began.
[[nodiscard]] std::vector<NamedLink> link_qualities(const World& world);

}  // namespace tandem::netsim
