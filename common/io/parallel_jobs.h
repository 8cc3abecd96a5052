#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Independent pieces of work side by side on all cores: the seeds of a test, the points of a grid, the sessions of a swarm.
namespace tandem::io {

/// What became of one piece.
struct JobResult {
  enum class State { kNotRun, kDone, kCrashed };
  State state = State::kNotRun;
  std::string text;    ///< what it returned
  std::string reason;  ///< of a crash, for people: the signal or exception, and the last that it wrote to standard error
};

struct JobsProgress {
  std::size_t count = 0, done = 0, running = 0;
  double share = 0;      ///< of all work, pieces that run included [0, 1]
  double elapsed_s = 0;  ///< wall time
  double left_s = 0;     ///< estimate from the share; NaN while nothing is known
};

/// Told by a piece how far it is. Costs one store.
class JobShare {
 public:
  explicit JobShare(float* slot) noexcept : slot_(slot) {}
  void set(double share) const noexcept;  ///< [0, 1]

 private:
  float* slot_;
};

struct JobsOptions {
  std::size_t jobs = 0;  ///< at a time; 0: one per core
  int stop_fd = -1;      ///< readable (signals_as_file): what runs is ended, what waits is not begun
  /// Called some times a second and once at the end, on the caller's thread.
  std::function<void(const JobsProgress&)> watch = {};
  /// Called when a piece is done or crashed, in any order. False: pieces of greater index are not wanted any more; what is
  /// kept then depends on indices alone, never on `jobs` or on who was faster.
  std::function<bool(std::size_t index, const JobResult& result)> keep_going = {};
};

/// Cores this process may use, at least 1.
[[nodiscard]] std::size_t cores();

/// Runs `work(index, share)` for every index in [0, count), begun in ascending order, each in a process of its own: a piece
/// that throws, aborts or runs wild is one bad result and touches no other, and there is no state that two could share.
/// The caller must have no other threads. What a piece changes in memory is gone with it; its result is the text.
/// @return one result per index
[[nodiscard]] std::vector<JobResult> run_jobs(std::size_t count,
                                              const std::function<std::string(std::size_t index, JobShare share)>& work,
                                              const JobsOptions& options = {});

}  // namespace tandem::io
