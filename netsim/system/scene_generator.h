#pragma once

#include <string>

#include "common/base/rng.h"
#include "proto/spec/scene_spec.h"

namespace tandem::netsim {

/// Returns the text of a random scene with 1 to 8 masters and 1 to 4 tools. The text is valid by construction:
/// authority sums to 1, gains keep the devices' passivity limits, and all devices are simulated.
/// @param duration_s  length of the session [s]
/// @param law         law of the hands, kSetPosition or kReplica; all other draws are the same for both
[[nodiscard]] std::string generate_scene_text(RandomKey key, double duration_s, LawKind law);

}  // namespace tandem::netsim
