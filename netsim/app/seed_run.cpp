#include "netsim/app/seed_run.h"

#include <algorithm>
#include <array>
#include <ctime>

#include "netsim/system/run_simulation.h"

namespace tandem::netsim {
namespace {

using State = SeedOutcome::State;

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

std::string_view name(State state) noexcept {
  constexpr std::array<std::string_view, 5> kNames{"not run", "pass", "fail", "trouble", "crash"};
  return kNames[static_cast<std::size_t>(state)];
}

SeedOutcome run_seed(const Scenario& scenario, std::uint64_t seed, const SeedRunObserver& observer) {
  SimulationConfig setup = scenario.setup;
  setup.seed = seed;
  setup.monitor_quality = true;
  const double begun = cpu_now();
  const auto go_on = [&](double session_s) {
    if (observer.progress) observer.progress(session_s / setup.scene.duration);
    return true;
  };
  const SimulationResult run = run_simulation(setup, {.keep_running = go_on, .trace = observer.trace});
  SeedOutcome out{.seed = seed,
                  .trouble = run.trouble,
                  .violations = run.report.violations,
                  .values = {},
                  .bands = {},
                  .notes = run.notes,
                  .network_text = quality_report(run.links, false),
                  .trace_hash = run.report.trace_hash,
                  .duration_s = run.report.duration_s,
                  .cpu_s = cpu_now() - begun,
                  .report = observer.report ? without_cpu_time(server::to_json(run.report)) : ""};
  for (const NamedLink& one : run.links) {
    out.bands.emplace_back(one.name, verdict_name(verdict(one.link)));
    out.badness = std::max(out.badness, badness(one.link));
  }
  bool good = run.report.passed;
  for (const Limit& limit : scenario.limits) {
    out.values.push_back(value_of(limit, run.report));
    good = good && holds(limit, out.values.back());
  }
  out.state = !out.trouble.empty() ? State::kTrouble : good ? State::kPass : State::kFail;
  return out;
}

}  // namespace tandem::netsim
