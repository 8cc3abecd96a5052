#include "netsim/app/seed_run.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>

#include "netsim/app/run_recording.h"
#include "netsim/system/run_simulation.h"

namespace tandem::netsim {
namespace {

using State = SeedOutcome::State;

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Records one run into the requested file.
class SeedRecorder {
 public:
  /// @param setup  receives the journal; outlives this object, as `request` does
  SeedRecorder(const RecordingRequest& request, SimulationConfig& setup) : request_(&request) {
    if (request.file.empty()) return;
    recording_ = std::make_unique<RunRecording>(setup, request.facts);
    setup.journal = &recording_->journal();
  }
  void begin(Simulation& simulation) {
    if (recording_ == nullptr) return;
    problem_ = recording_->open(request_->file);
    opened_ = problem_.empty();
    recording_->attach(simulation);
  }
  void on_tick(const Simulation& simulation) {
    if (recording_ != nullptr) recording_->on_tick(simulation);
  }
  void end(SeedOutcome& out) {
    if (recording_ == nullptr) return;
    if (opened_) problem_ = recording_->close();
    if (!opened_ && problem_.empty()) problem_ = "no session was made, so nothing could be recorded";
    if (problem_.empty()) out.recording = request_->file;
    out.recording_problem = problem_;
  }

 private:
  const RecordingRequest* request_;
  std::unique_ptr<RunRecording> recording_;
  std::string problem_;
  bool opened_ = false;
};

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
  SeedRecorder recorder(observer.recording, setup);
  const SimulationResult run =
      run_simulation(setup, {.keep_running = go_on,
                             .trace = observer.trace,
                             .begin = [&](Simulation& simulation) { recorder.begin(simulation); },
                             .tick = [&](Simulation& simulation) { recorder.on_tick(simulation); }});
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
  recorder.end(out);
  return out;
}

}  // namespace tandem::netsim
