#include "netsim/testing/scene_run.h"

#include <sstream>

#include "common/transport/digest.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/system/session_notes.h"
#include "netsim/system/simulation_report.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/report/trace_csv.h"

namespace tandem::netsim {

std::expected<SimulationConfig, std::string> simulation_config(const SceneRun& run) {
  std::string mistakes;
  SimulationConfig setup;
  setup.seed = run.seed;
  if (const ShippedScene* const shipped = find_shipped_scene(run.scene); shipped == nullptr) {
    mistakes += "there is no scene " + run.scene + "; there are:";
    for (const ShippedScene& scene : shipped_scenes()) mistakes += " " + std::string(scene.name);
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

std::expected<server::RunReport, std::string> run_simulation(const SimulationConfig& setup) {
  auto made = Simulation::make(setup);
  if (!made) return std::unexpected(made.error());
  Simulation& simulation = **made;
  server::ReportBuilder builder{simulation.scene()};
  const server::TraceCsv csv{simulation.scene()};
  transport::Digest digest;
  std::string row = csv.header();
  digest.add(row);
  while (simulation.step()) {
    const server::TickRecord& record = simulation.record();
    builder.add(record);
    if (!record.running) continue;
    row.clear();
    csv.append(record, row);
    digest.add(row);
  }
  if (!simulation.trouble().empty()) return std::unexpected(simulation.trouble());
  server::RunReport report = simulation_report(simulation, builder, setup.seed);
  report.trace_hash = digest.hex();
  return report;
}

std::expected<server::RunReport, std::string> run_scene(const SceneRun& run) {
  const auto setup = simulation_config(run);
  if (!setup) return std::unexpected(setup.error());
  return run_simulation(*setup);
}

std::string replay_command(const SceneRun& run) {
  std::ostringstream command;
  command << "tandem-netsim run " << run.scene << " --profile " << run.profile << " --seed " << run.seed;
  if (run.duration_s > 0) command << " --duration " << run.duration_s;
  command << " --trace trace.csv";
  return command.str();
}

}  // namespace tandem::netsim
