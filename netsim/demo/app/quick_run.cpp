#include "netsim/demo/app/quick_run.h"

#include <cmath>
#include <ctime>

#include "common/link/digest.h"
#include "netsim/world_report.h"
#include "proto/scene_text.h"
#include "proto/scenes_embedded.h"
#include "server/trace_csv.h"

namespace tandem::netsim::demo {
namespace {

Duration milliseconds(double ms) { return Duration{std::llround(ms * 1e6)}; }

std::string command_of(const RunPlan& plan) {
  std::string text = "tandem-netsim run " + std::string(plan.scene);
  if (plan.setting == Setting::kBadNetwork) text += " --delay 20 --jitter 5 --loss 5 --seed 1";
  const std::string name(plan.name);
  return text + " --json " + name + ".json --trace " + name + ".csv";
}

std::expected<SceneSpec, std::string> scene_of(const RunPlan& plan) {
  const ShippedScene* shipped = find_shipped_scene(plan.scene);
  if (shipped == nullptr)
    return std::unexpected("scene " + std::string(plan.scene) + " is not shipped with this program");
  auto scene = parse_scene(shipped->text, plan.scene);
  if (!scene) return std::unexpected(to_text(scene.error()));
  return std::move(*scene);
}

}  // namespace

Springs springs_of(const RunPlan& plan) {
  const auto scene = scene_of(plan);
  if (!scene || scene->tools.empty()) return {};
  return {scene->coupling.k_c, scene->channel.k, scene->tools.front().k_s};
}

std::expected<RawRun, std::string> quick_run(const RunPlan& plan, const RunWatch& watch) {
  auto scene = scene_of(plan);
  if (!scene) return std::unexpected(scene.error());

  WorldSetup setup;
  setup.scene = std::move(*scene);
  setup.seed = kSeedNumber;
  if (plan.setting == Setting::kBadNetwork)
    setup.network = link_from(
        {.delay = milliseconds(kBadDelayMs), .jitter = milliseconds(kBadJitterMs), .loss = kBadLossPercent / 100});
  const std::clock_t begin = std::clock();
  auto made = World::make(setup);
  if (!made) return std::unexpected(made.error());
  World& world = **made;
  server::ReportBuilder builder{world.scene()};
  const server::TraceCsv csv{world.scene()};

  RawRun run;
  run.trace = csv.header();
  for (std::uint64_t n = 0; world.step(); ++n) {
    builder.add(world.record());
    if (world.record().running) csv.append(world.record(), run.trace);
    if (n % 250 != 0) continue;
    if (watch.stop->load()) return std::unexpected(kInterrupted);
    watch.progress(world.session().time());
  }
  if (!world.trouble().empty()) return std::unexpected(world.trouble());
  server::RunReport report = world_report(world, builder, setup.seed);
  link::Digest digest;
  digest.add(run.trace);
  report.trace_hash = digest.hex();
  report.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  run.json = server::to_json(report);
  run.commands = {command_of(plan)};
  return run;
}

}  // namespace tandem::netsim::demo
