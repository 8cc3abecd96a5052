#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "netsim/world.h"
#include "server/report.h"

namespace tandem::netsim {

/// One whole session in virtual time, named as on the command line.
struct SceneRun {
  std::string scene;              ///< a shipped scene: `tandem-server scenes`
  std::string profile = "ideal";  ///< a shipped network: `tandem-netsim profiles`
  std::uint64_t seed = 1;
  double duration_s = 0;  ///< 0: the scene's own
};

/// The setup that a run stands for, to be changed before `run_world`. Error: all mistakes, one per line.
[[nodiscard]] std::expected<WorldSetup, std::string> world_setup(const SceneRun& run);

/// Runs a session to its end and judges it. Same setup: same report and `trace_hash`, which is the SHA-256 of the same rows
/// that `tandem-netsim run --trace` writes.
/// Error: the session could not be made or did not begin.
[[nodiscard]] std::expected<server::RunReport, std::string> run_world(const WorldSetup& setup);

/// Both together.
[[nodiscard]] std::expected<server::RunReport, std::string> run_scene(const SceneRun& run);

/// What a person types to see the same run again, with every tick in a file.
[[nodiscard]] std::string replay_command(const SceneRun& run);

}  // namespace tandem::netsim
