#pragma once

#include <string>

#include "proto/spec/scene_spec.h"

/// The options --channel and --mfs of the commands that run a scene.
namespace tandem::netsim {

/// Replaces the law and the flow sources of a scene. @param channel, mfs  as typed; empty: those of the scene stay
void set_law(SceneSpec& scene, const std::string& channel, const std::string& mfs);

/// Returns the conflict between the law of a scene and its other keys, `SCENE: KEY: TEXT`; empty if there is none.
/// @param name  of the scene, as typed
[[nodiscard]] std::string law_conflict(const SceneSpec& scene, const std::string& name);

}  // namespace tandem::netsim
