#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "common/io/parallel_jobs.h"
#include "netsim/app/test_run.h"

/// Recordings of the failed seeds of a test: option --record-failures of `test`.
namespace tandem::netsim {

/// Largest number of files that one call writes. A CI server stores them, and a change that breaks everything breaks
/// every seed.
inline constexpr std::size_t kFailureRecordingsMax = 20;

struct FailureRecordingOptions {
  std::string folder;        ///< is made if it is missing and a seed failed
  std::size_t jobs = 0;      ///< 0: one per core
  int stop_fd = -1;          ///< as in io::JobOptions
  bool interrupted = false;  ///< a signal has come: nothing is repeated
  std::function<void(const io::JobProgress&, std::size_t failed)> on_progress = {};
};

/// Returns for users why no file could be written into a folder of this name, empty if it could. Creates nothing.
[[nodiscard]] std::string recording_folder_problem(const std::string& folder);

/// Repeats the failed seeds with a recorder, the first kFailureRecordingsMax of them in the order of the table. Their
/// files are called SCENARIO-seed-N.mcap, and SCENARIO-seed-N-K.mcap for the K-th scenario of the same name; older
/// files of these names are replaced. A repeat must end as the run did, with the same trace_hash. Fills
/// TestResult::recordings, SeedOutcome::recording and recording_problem; verdicts stay as they are.
void record_failures(TestResult& result, const FailureRecordingOptions& options);

}  // namespace tandem::netsim
