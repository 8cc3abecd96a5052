#include "netsim/system/scene_run.h"

#include <utility>

#include "common/base/format.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/system/run_simulation.h"
#include "netsim/system/session_notes.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::netsim {

std::expected<SimulationConfig, std::string> simulation_config(const SceneRun& run) {
  std::string mistakes;
  SimulationConfig setup;
  setup.seed = run.seed;
  if (const EmbeddedFile* const shipped = find_shipped_scene(run.scene); shipped == nullptr) {
    mistakes += "there is no scene " + run.scene + "; there are:";
    for (const EmbeddedFile& scene : shipped_scenes()) mistakes += " " + std::string(scene.name);
    mistakes += "\n";
  } else if (auto scene = parse_scene(shipped->text, run.scene + ".textproto")) {
    setup.scene = std::move(*scene);
  } else {
    mistakes += to_text(scene.error());
  }
  if (auto profile = shipped_profile(run.profile)) {
    setup.network = profile->link;
    if (profile->capacity_file)
      mistakes += "profile " + run.profile + " needs a recorded capacity, which a program must supply\n";
  } else {
    mistakes += to_text(profile.error());
  }
  if (!(run.duration_s >= 0 && run.duration_s <= 3e6)) mistakes += "duration_s must be in [0, 3e6]\n";
  if (run.duration_s == 0 && !setup.scene.seats.empty() && setup.scene.endless())
    mistakes += endless_scene_error(run.scene, "set SceneRun::duration_s") + "\n";
  if (!mistakes.empty()) return std::unexpected(std::move(mistakes));
  if (run.duration_s > 0) setup.scene.duration = run.duration_s;
  return setup;
}

std::expected<server::RunReport, std::string> run_scene(const SceneRun& run) {
  const auto setup = simulation_config(run);
  if (!setup) return std::unexpected(setup.error());
  SimulationResult result = run_simulation(*setup);
  if (!result.trouble.empty()) return std::unexpected(std::move(result.trouble));
  return std::move(result.report);
}

std::string replay_command(const SceneRun& run) {
  return "tandem-netsim run " + run.scene + " --profile " + run.profile + " --seed " + std::to_string(run.seed) +
         (run.duration_s > 0 ? format(" --duration %g", run.duration_s) : "") + " --trace trace.csv";
}

}  // namespace tandem::netsim
