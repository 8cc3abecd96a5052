#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/io/parallel_jobs.h"
#include "netsim/app/seed_run.h"

namespace tandem::netsim {

struct TestOptions {
  std::optional<std::uint64_t> seed = {}, seeds = {};  ///< first seed and how many, instead of the scenario's
  std::size_t jobs = 0;                      ///< 0: one per core
  bool fail_fast = false;                    ///< nothing after the first failure, in the order of scenarios and seeds
  bool reports = false;                      ///< SeedOutcome::report of every seed
  std::string trace = {};                    ///< file for the rows of the only seed
  int stop_fd = -1;                          ///< as io::JobsOptions
  std::function<void(const io::JobsProgress&, std::size_t failed)> watch = {};
};

struct ScenarioResult {
  Scenario scenario;
  std::vector<SeedOutcome> seeds;  ///< ascending; a seed that was not run says so

  [[nodiscard]] std::size_t count(SeedOutcome::State state) const noexcept;
  [[nodiscard]] std::size_t failed() const noexcept;
  [[nodiscard]] bool passed() const noexcept;  ///< every seed was run and passed
  /// Virtual seconds per second of one core; 0 when nothing ran.
  [[nodiscard]] double real_time() const noexcept;
};

struct TestResult {
  std::vector<ScenarioResult> scenarios;
  double wall_s = 0;
  bool interrupted = false;  ///< a signal ended it before every seed was run

  [[nodiscard]] bool passed() const noexcept;
  [[nodiscard]] std::size_t not_run() const noexcept;
  [[nodiscard]] std::size_t all() const noexcept;  ///< seeds of all scenarios
};

/// Runs all seeds of all scenarios side by side. The result does not depend on `jobs`, but for cpu_s and wall_s.
[[nodiscard]] TestResult run_tests(std::vector<Scenario> scenarios, const TestOptions& options);

/// Every cause of a failure, one line each; empty for a seed that passed or was not run.
[[nodiscard]] std::vector<std::string> causes(const Scenario& scenario, const SeedOutcome& outcome);

/// The one command that runs this seed again and writes its trace.
[[nodiscard]] std::string replay_command(const Scenario& scenario, std::uint64_t seed);

}  // namespace tandem::netsim
