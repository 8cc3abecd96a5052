#pragma once

#include <string>
#include <vector>

#include "proto/spec/scene_spec.h"

/// The options --channel, --coupling and --mfs of the commands that run a scene.
namespace tandem::netsim {

/// Replaces the coupling between the hands of a scene. @param coupling  as typed; empty: that of the scene stays
void set_coupling(SceneSpec& scene, const std::string& coupling);
/// Names of the couplings that --coupling takes.
[[nodiscard]] std::vector<std::string> coupling_names();
/// Help text of --coupling: every coupling with its summary.
[[nodiscard]] std::string coupling_help();

/// Names of the channel laws that --channel takes.
[[nodiscard]] std::vector<std::string> law_names();
/// Help text of --channel: every law with its summary.
[[nodiscard]] std::string law_help();

/// Replaces the law and the flow sources of a scene. @param channel, mfs  as typed; empty: those of the scene stay
void set_law(SceneSpec& scene, const std::string& channel, const std::string& mfs);

/// Returns the option that a conflict of the law is to be reported at. @param channel, coupling  as typed
[[nodiscard]] const char* law_option(const std::string& channel, const std::string& coupling) noexcept;

/// Returns the conflict between the law of a scene and its other keys, `SCENE: KEY: TEXT`; empty if there is none.
/// @param name  of the scene, as typed
[[nodiscard]] std::string law_conflict(const SceneSpec& scene, const std::string& name);

}  // namespace tandem::netsim
