#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Runs independent jobs in parallel on all cores: the seeds of a test, the points of a grid, the sessions of a soak
/// test.
namespace tandem::io {

/// Result of one job.
struct JobResult {
  enum class State { kNotRun, kDone, kCrashed };
  State state = State::kNotRun;
  std::string text;    ///< text returned by the job
  std::string reason;  ///< of a crash, for users: the signal or exception, and the last text written to standard error
};

/// Progress of all jobs.
struct JobProgress {
  std::size_t count = 0, done = 0, running = 0;
  double share = 0;      ///< completed share of all work, running jobs included [0, 1]
  double elapsed_s = 0;  ///< wall time
  double left_s = 0;     ///< estimate from the share; NaN while unknown
};

/// Reports the progress of one job. Costs one store.
class JobProgressReporter {
 public:
  explicit JobProgressReporter(float* slot) noexcept : slot_(slot) {}
  void set(double share) const noexcept;  ///< [0, 1]

 private:
  float* slot_;
};

struct JobOptions {
  std::size_t jobs = 0;  ///< concurrent jobs; 0: one per core
  int stop_fd =
      -1;  ///< when it becomes readable (make_signalfd), running jobs are ended and waiting jobs are not started
  /// Called a few times per second and once at the end, on the caller's thread.
  std::function<void(const JobProgress&)> watch = {};
  /// Called when a job is done or crashed, in any order. False: results of greater index are not wanted. The kept
  /// results then depend on indices alone, never on `jobs` or on timing.
  std::function<bool(std::size_t index, const JobResult& result)> keep_going = {};
};

/// Returns the number of cores this process may use, at least 1.
[[nodiscard]] std::size_t cores();

/// Runs `work(index, share)` for every index in [0, count), started in ascending order, each in a process of its own. A
/// job that throws, aborts or corrupts memory is one failed result and affects no other; jobs share no state. The
/// caller must have no other threads. Changes of memory by a job are lost; its result is the text.
/// @return one result per index
[[nodiscard]] std::vector<JobResult> run_jobs(
    std::size_t count, const std::function<std::string(std::size_t index, JobProgressReporter share)>& work,
    const JobOptions& options = {});

}  // namespace tandem::io
