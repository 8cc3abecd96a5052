#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "netsim/system/simulation_config.h"
#include "server/report/report.h"

namespace tandem::netsim {

/// One whole session in virtual time, with the names that the command line uses.
struct SceneRun {
  std::string scene;              ///< name of a shipped scene, see `tandem-server scenes`
  std::string profile = "ideal";  ///< name of a shipped network, see `tandem-netsim profiles`
  std::uint64_t seed = 1;         ///< seed of all random draws
  double duration_s = 0;          ///< length of the session [s], [0, 3e6]; 0: the scene's own
};

/// Returns the configuration of a run, which the caller may change before `run_simulation`.
/// Error: all errors of the names and values, one per line.
[[nodiscard]] std::expected<SimulationConfig, std::string> simulation_config(const SceneRun& run);

/// Runs a session to its end and returns its report. The same run gives the same report and `trace_hash`. That hash is
/// the SHA-256 of the rows that `tandem-netsim run --trace` writes. Error: all errors of the names and values, or why
/// the session did not begin.
[[nodiscard]] std::expected<server::RunReport, std::string> run_scene(const SceneRun& run);

/// Returns the shell command that repeats the run and writes every tick to a file.
[[nodiscard]] std::string replay_command(const SceneRun& run);

}  // namespace tandem::netsim
