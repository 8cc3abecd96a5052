#include "netsim/demo/app/quick_run.h"

#include <cmath>
#include <ctime>
#include <limits>
#include <optional>

#include "common/base/milliseconds.h"
#include "netsim/demo/app/network_series.h"
#include "netsim/system/run_simulation.h"
#include "netsim/system/session_notes.h"
#include "netsim/system/simulation.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::netsim::demo {
namespace {

/// Capacity of the decision log: two seats, both directions, 1000 decisions per second each, and a reserve for the
/// joins.
constexpr double kDecisionsPerSecond = 5000, kJoining = 10;

std::expected<SceneSpec, std::string> scene_of(const RunPlan& plan) {
  const EmbeddedFile* shipped = find_shipped_scene(plan.scene);
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
  constexpr double kNone = std::numeric_limits<double>::infinity();  // no such spring
  const bool local = scene->channel.law == LawKind::kReplica;
  return {granted_stiffness(*scene, 0), local ? kNone : scene->channel.k,
          scene->tools.front().is_virtual ? kNone : scene->tools.front().k_s};
}

std::expected<RawRun, std::string> quick_run(const RunPlan& plan, const RunObserver& observer) {
  auto scene = scene_of(plan);
  if (!scene) return std::unexpected(scene.error());

  SimulationConfig setup;
  setup.scene = std::move(*scene);
  setup.seed = kSeedNumber;
  if (plan.setting == Setting::kBadNetwork)
    setup.network = link_from({.delay = from_milliseconds(kBadDelayMs),
                               .jitter = from_milliseconds(kBadJitterMs),
                               .loss = kBadLossPercent / 100});
  const std::clock_t begin = std::clock();
  auto made = Simulation::make(setup);
  if (!made) return std::unexpected(made.error());
  Simulation& simulation = **made;
  const bool bad = plan.setting == Setting::kBadNetwork;
  DecisionLog decisions{bad ? static_cast<std::size_t>(kDecisionsPerSecond * (plan.duration_s + kJoining)) : 0};
  if (bad) simulation.network().log_to(&decisions);
  std::optional<Time> begun;
  RawRun run;
  SimulationResult result = run_simulation(simulation, setup.seed,
                                           {.keep_running =
                                                [&](double session_s) {
                                                  observer.progress(session_s);
                                                  return !observer.stop->load();
                                                },
                                            .trace = [&](std::string_view rows) { run.trace += rows; },
                                            .tick =
                                                [&](Simulation& now) {
                                                  if (!begun && now.record().running) begun = now.now();
                                                }});
  if (result.interrupted) return std::unexpected(kInterrupted);
  if (!result.trouble.empty()) return std::unexpected(result.trouble);
  result.report.feel.clear();  // the demo measures its own numbers
  result.report.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  run.json = server::to_json(result.report);
  if (begun) run.network = network_series(decisions.rows(), *begun, plan.duration_s);
  return run;
}

}  // namespace tandem::netsim::demo
