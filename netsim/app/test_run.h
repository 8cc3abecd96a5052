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
  std::optional<std::uint64_t> seed = {}, seeds = {};  ///< first seed and number of seeds; they replace the scenario's
  std::size_t jobs = 0;                                ///< 0: one per core
  bool fail_fast = false;  ///< stops after the first failure, in the order of scenarios and seeds
  bool reports = false;    ///< fills SeedOutcome::report of every seed
  std::string trace = {};  ///< file for the rows; requires a single seed
  int stop_fd = -1;        ///< as in io::JobOptions
  std::function<void(const io::JobProgress&, std::size_t failed)> on_progress = {};
};

/// Value of a limit that is nearest to breaking it, or exceeds it most.
struct WorstValue {
  const Limit* limit = nullptr;
  double value = 0;
  std::uint64_t seed = 0;
  [[nodiscard]] double room() const noexcept { return slack(*limit, value); }
};

struct ScenarioResult {
  Scenario scenario;
  std::vector<SeedOutcome> seeds;  ///< ascending; includes the seeds that were not run

  [[nodiscard]] std::size_t count(SeedOutcome::State state) const noexcept;
  [[nodiscard]] std::size_t failed() const noexcept;
  [[nodiscard]] bool passed() const noexcept;   ///< returns whether every seed was run and passed
  [[nodiscard]] double cpu_s() const noexcept;  ///< returns the sum of its seeds
  /// Returns the worst value of a limit of the scenario; nullopt if no seed was judged by it. It refers to the limit.
  [[nodiscard]] std::optional<WorstValue> worst_of(std::size_t limit) const;
  /// Returns virtual seconds per second of one core; 0 if no seed ran.
  [[nodiscard]] double real_time() const noexcept;
};

/// Recordings of failed seeds (netsim/app/failure_recordings.h).
struct FailureRecordings {
  std::string folder;
  std::size_t left_out = 0;  ///< failed seeds beyond the largest number of files
};

struct TestResult {
  std::vector<ScenarioResult> scenarios;
  double wall_s = 0;
  bool interrupted = false;                          ///< a signal ended it before every seed was run
  std::optional<FailureRecordings> recordings = {};  ///< nullopt: not requested

  [[nodiscard]] bool passed() const noexcept;
  [[nodiscard]] std::size_t not_run() const noexcept;
  [[nodiscard]] std::size_t failed() const noexcept;
  [[nodiscard]] std::size_t all() const noexcept;       ///< returns the number of seeds of all scenarios
  [[nodiscard]] std::size_t recorded() const noexcept;  ///< returns the number of seeds that have a recording
};

/// Runs all seeds of all scenarios in parallel. The result does not depend on `jobs`, except for cpu_s and wall_s.
[[nodiscard]] TestResult run_tests(std::vector<Scenario> scenarios, const TestOptions& options);

/// Returns every cause of a failure, one line each; empty for a seed that passed or was not run.
[[nodiscard]] std::vector<std::string> causes(const Scenario& scenario, const SeedOutcome& outcome);

/// Returns the file with the recording of a failed seed, and why there is none or what it lacks, one line each; empty
/// if no recording was requested, and for seeds beyond the largest number of files.
[[nodiscard]] std::vector<std::string> recording_lines(const SeedOutcome& outcome);

/// Returns the command that runs this seed again and writes its trace.
[[nodiscard]] std::string replay_command(const Scenario& scenario, std::uint64_t seed);

}  // namespace tandem::netsim
