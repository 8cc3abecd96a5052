#include "netsim/testing/scene_run.h"

#include <sstream>

#include "common/link/digest.h"
#include "netsim/profiles.h"
#include "netsim/world_notes.h"
#include "netsim/world_report.h"
#include "proto/scene_text.h"
#include "proto/scenes_embedded.h"
#include "server/trace_csv.h"

namespace tandem::netsim {

std::expected<WorldSetup, std::string> world_setup(const SceneRun& run) {
  std::string mistakes;
  WorldSetup setup;
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
    if (profile->capacity_file) mistakes += "profile " + run.profile + " needs a recorded capacity, which a program must supply\n";
  } else {
    mistakes += to_text(profile.error());
  }
  if (!(run.duration_s >= 0 && run.duration_s <= 3e6)) mistakes += "duration_s must be in [0, 3e6]\n";
  if (run.duration_s == 0 && !setup.scene.seats.empty() && setup.scene.endless()) mistakes += no_end(run.scene, "set SceneRun::duration_s") + "\n";
  if (!mistakes.empty()) return std::unexpected(std::move(mistakes));
  if (run.duration_s > 0) setup.scene.duration = run.duration_s;
  return setup;
}

std::expected<server::RunReport, std::string> run_world(const WorldSetup& setup) {
  auto made = World::make(setup);
  if (!made) return std::unexpected(made.error());
  World& world = **made;
  server::ReportBuilder builder{world.scene()};
  const server::TraceCsv csv{world.scene()};
  link::Digest digest;
  std::string row = csv.header();
  digest.add(row);
  while (world.step()) {
    const server::TickRecord& record = world.record();
    builder.add(record);
    if (!record.running) continue;
    row.clear();
    csv.append(record, row);
    digest.add(row);
  }
  if (!world.trouble().empty()) return std::unexpected(world.trouble());
  server::RunReport report = world_report(world, builder, setup.seed);
  report.trace_hash = digest.hex();
  return report;
}

std::expected<server::RunReport, std::string> run_scene(const SceneRun& run) {
  const auto setup = world_setup(run);
  if (!setup) return std::unexpected(setup.error());
  return run_world(*setup);
}

std::string replay_command(const SceneRun& run) {
  std::ostringstream command;
  command << "tandem-netsim run " << run.scene << " --profile " << run.profile << " --seed " << run.seed;
  if (run.duration_s > 0) command << " --duration " << run.duration_s;
  command << " --trace trace.csv";
  return command.str();
}

}  // namespace tandem::netsim
