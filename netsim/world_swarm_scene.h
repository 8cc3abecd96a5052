#pragma once

#include <string>

#include "common/base/rng.h"
#include "proto/scene_spec.h"

namespace tandem::netsim {

/// The text of a random scene of 1 to 8 masters and 1 to 4 tools. Valid by construction: weights sum to 1, gains keep their
/// devices' passivity limits, and only simulated devices are in it.
/// @param duration_s  of the session
/// @param law         of hands, kSetPosition or kReplica; all else is drawn alike
[[nodiscard]] std::string draw_scene_text(RandomKey key, double duration_s, LawKind law);

}  // namespace tandem::netsim
