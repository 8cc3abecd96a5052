#include "netsim/app/test_run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/io/output_file.h"

namespace tandem::netsim {
namespace {

using State = SeedOutcome::State;

std::string run_in_child(const Scenario& scenario, std::uint64_t seed, const TestOptions& options,
                         io::JobProgressReporter share) {
  io::OutputFile trace;
  if (const std::string problem = trace.open(options.trace, false); !problem.empty()) throw std::runtime_error(problem);
  SeedRunObserver observer{.progress = [&](double part) { share.set(part); }, .report = options.reports};
  if (trace.is_open()) observer.trace = [&](std::string_view rows) { trace.write(rows); };
  const SeedOutcome outcome = run_seed(scenario, seed, observer);
  if (const std::string problem = trace.close(); !problem.empty()) throw std::runtime_error(problem);
  return to_bytes(outcome);
}

std::string violation_text(const server::Violation& v) {
  return "invariant " + v.invariant + " broken" + (v.seat.empty() ? "" : " at " + v.seat) +
         format(", first at %.3f s, %llu times", v.at_s, static_cast<unsigned long long>(v.count));
}

/// Returns the sum of a number over all items, from `zero` on.
auto total_of(const auto& items, auto zero, auto number) {
  for (const auto& item : items) zero += std::invoke(number, item);
  return zero;
}

}  // namespace

std::size_t ScenarioResult::count(State state) const noexcept {
  return static_cast<std::size_t>(std::ranges::count(seeds, state, &SeedOutcome::state));
}
std::size_t ScenarioResult::failed() const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(seeds, &SeedOutcome::failed));
}
bool ScenarioResult::passed() const noexcept { return count(State::kPass) == seeds.size(); }

double ScenarioResult::cpu_s() const noexcept { return total_of(seeds, 0.0, &SeedOutcome::cpu_s); }
double ScenarioResult::real_time() const noexcept {
  return cpu_s() > 0 ? total_of(seeds, 0.0, &SeedOutcome::duration_s) / cpu_s() : 0;
}

std::optional<WorstValue> ScenarioResult::worst_of(std::size_t limit) const {
  std::optional<WorstValue> worst;
  for (const SeedOutcome& s : seeds) {
    if (limit >= s.values.size() || (s.state != State::kPass && s.state != State::kFail)) continue;
    const WorstValue one{&scenario.limits[limit], s.values[limit], s.seed};
    if (!worst || one.room() < worst->room()) worst = one;
  }
  return worst;
}

bool TestResult::passed() const noexcept { return std::ranges::all_of(scenarios, &ScenarioResult::passed); }
std::size_t TestResult::not_run() const noexcept {
  return total_of(scenarios, std::size_t{0}, [](const ScenarioResult& s) { return s.count(State::kNotRun); });
}
std::size_t TestResult::failed() const noexcept { return total_of(scenarios, std::size_t{0}, &ScenarioResult::failed); }
std::size_t TestResult::all() const noexcept {
  return total_of(scenarios, std::size_t{0}, [](const ScenarioResult& s) { return s.seeds.size(); });
}
std::size_t TestResult::recorded() const noexcept {
  return total_of(scenarios, std::size_t{0}, [](const ScenarioResult& s) {
    return static_cast<std::size_t>(
        std::ranges::count_if(s.seeds, [](const SeedOutcome& seed) { return !seed.recording.empty(); }));
  });
}

TestResult run_tests(std::vector<Scenario> scenarios, const TestOptions& options) {
  TestResult result;
  struct Place {
    std::size_t scenario, seed;
  };
  std::vector<Place> places;
  for (Scenario& scenario : scenarios) {
    ScenarioResult& one = result.scenarios.emplace_back();
    const std::uint64_t first = options.seed.value_or(scenario.seed);
    one.seeds.resize(options.seeds.value_or(scenario.seeds));
    for (std::size_t i = 0; i < one.seeds.size(); ++i) {
      one.seeds[i].seed = first + i;
      places.push_back({result.scenarios.size() - 1, i});
    }
    one.scenario = std::move(scenario);
  }
  const auto outcome_of = [&](std::size_t index) -> SeedOutcome& {
    return result.scenarios[places[index].scenario].seeds[places[index].seed];
  };
  std::size_t failed = 0;
  const auto understand = [&](std::size_t index, const io::JobResult& job) {
    SeedOutcome out;
    if (job.state == io::JobResult::State::kDone) {
      out = outcome_from_bytes(job.text);
    } else if (job.state == io::JobResult::State::kCrashed) {
      out.state = State::kCrash;
      out.trouble = job.reason;
    }
    out.seed = outcome_of(index).seed;
    return out;
  };
  const auto jobs = io::run_jobs(places.size(),
                                 [&](std::size_t index, io::JobProgressReporter share) {
                                   return run_in_child(result.scenarios[places[index].scenario].scenario,
                                                       outcome_of(index).seed, options, share);
                                 },
                                 {.jobs = options.jobs,
                                  .stop_fd = options.stop_fd,
                                  .watch =
                                      [&](const io::JobProgress& p) {
                                        result.wall_s = p.elapsed_s;
                                        if (options.on_progress) options.on_progress(p, failed);
                                      },
                                  .keep_going =
                                      [&](std::size_t index, const io::JobResult& job) {
                                        const bool bad = understand(index, job).failed();
                                        failed += bad ? 1 : 0;
                                        return !(bad && options.fail_fast);
                                      }});
  for (std::size_t i = 0; i < jobs.size(); ++i) outcome_of(i) = understand(i, jobs[i]);
  return result;
}

std::vector<std::string> causes(const Scenario& scenario, const SeedOutcome& outcome) {
  std::vector<std::string> out;
  if (outcome.state == State::kNotRun || outcome.state == State::kPass) return out;
  if (outcome.state == State::kCrash) out.push_back("the run crashed: " + outcome.trouble);
  if (outcome.state == State::kTrouble) out.push_back(outcome.trouble);
  for (const server::Violation& v : outcome.violations)
    if (!v.expected) out.push_back(violation_text(v));
  if (outcome.state != State::kFail) return out;
  for (std::size_t i = 0; i < scenario.limits.size() && i < outcome.values.size(); ++i) {
    const Limit& limit = scenario.limits[i];
    const double value = outcome.values[i];
    if (holds(limit, value)) continue;
    out.push_back(limit.subject + ": " + limit.metric + " = " + short_number(value) +
                  (limit.unit.empty() || std::isnan(value) ? "" : " " + limit.unit) + ", must be " + range_text(limit));
  }
  return out;
}

std::vector<std::string> recording_lines(const SeedOutcome& outcome) {
  std::vector<std::string> out;
  if (!outcome.recording.empty()) out.push_back("recording: " + outcome.recording);
  if (!outcome.recording_problem.empty())
    out.push_back((outcome.recording.empty() ? "not recorded: " : "note on the recording: ") +
                  outcome.recording_problem);
  return out;
}

std::string replay_command(const Scenario& scenario, std::uint64_t seed) {
  const std::string number = std::to_string(seed);
  return "tandem-netsim test " + shell_quote(scenario.file) + " --seed " + number + " --seeds 1 --trace " +
         shell_quote(scenario.name + "-" + number + ".csv");
}

}  // namespace tandem::netsim
