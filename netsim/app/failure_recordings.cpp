#include "netsim/app/failure_recordings.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <vector>

#include "common/io/output_file.h"

namespace tandem::netsim {
namespace {

namespace fs = std::filesystem;

/// Seed to be repeated. The pointers refer to the result of the test.
struct FailedSeed {
  const Scenario* scenario = nullptr;
  SeedOutcome* outcome = nullptr;
  std::string file;
};

/// Returns the failed seeds of all scenarios in the order of the table, each with its file.
std::vector<FailedSeed> failed_seeds(TestResult& result, const fs::path& folder) {
  std::vector<FailedSeed> all;
  for (std::size_t i = 0; i < result.scenarios.size(); ++i) {
    ScenarioResult& r = result.scenarios[i];
    const auto same_name =
        std::count_if(result.scenarios.begin(), result.scenarios.begin() + static_cast<std::ptrdiff_t>(i),
                      [&](const ScenarioResult& earlier) { return earlier.scenario.name == r.scenario.name; });
    const std::string suffix = same_name == 0 ? "" : "-" + std::to_string(same_name + 1);
    for (SeedOutcome& s : r.seeds)
      if (s.failed())
        all.push_back({&r.scenario, &s,
                       (folder / (r.scenario.name + "-seed-" + std::to_string(s.seed) + suffix + ".mcap")).string()});
  }
  return all;
}

RecordingRequest request_of(const FailedSeed& seed) {
  std::string text;
  for (const std::string& cause : causes(*seed.scenario, *seed.outcome)) text += (text.empty() ? "" : "\n") + cause;
  return {.file = seed.file,
          .facts = {{"program", "tandem-netsim test"},
                    {"scenario", seed.scenario->name},
                    {"verdict", std::string(name(seed.outcome->state))},
                    {"causes", text}}};
}

/// Takes the file of a repeat, and what is wrong with it.
void take_recording(const FailedSeed& seed, const io::JobResult& job) {
  SeedOutcome& out = *seed.outcome;
  if (job.state == io::JobResult::State::kNotRun) {
    out.recording_problem = "interrupted before the recording was complete";
    return;
  }
  if (job.state == io::JobResult::State::kCrashed) {
    std::error_code error;
    if (fs::exists(seed.file, error)) out.recording = seed.file;
    out.recording_problem =
        "the repeat crashed (" + job.reason + ")" + (out.recording.empty() ? "" : "; the file ends before that");
    return;
  }
  const SeedOutcome again = outcome_from_bytes(job.text);
  out.recording = again.recording;
  out.recording_problem = again.recording_problem;
  if (again.recording.empty() || (again.state == out.state && again.trace_hash == out.trace_hash)) return;
  out.recording_problem = "it has another run: the repeat ended with " + std::string(name(again.state)) +
                          " and trace_hash " + again.trace_hash + ", the run itself with " +
                          std::string(name(out.state)) + (out.trace_hash.empty() ? "" : " and " + out.trace_hash);
}

}  // namespace

std::string recording_folder_problem(const std::string& folder) {
  if (folder == "-") return "names a folder; standard output is for --json";
  std::error_code error;
  fs::path place = fs::absolute(folder, error);
  if (error) return folder + ": " + error.message();
  while (!fs::exists(place, error) && place != place.parent_path()) place = place.parent_path();
  if (!fs::is_directory(place, error))
    return folder + ": " + place.string() + " is no folder; name another place, a missing folder is made";
  if (access(place.c_str(), W_OK | X_OK) == 0) return {};
  return folder + ": nothing can be written into " + place.string() + ": " + io::write_error_text(errno);
}

void record_failures(TestResult& result, const FailureRecordingOptions& options) {
  FailureRecordings& recordings = result.recordings.emplace(FailureRecordings{.folder = options.folder});
  std::vector<FailedSeed> failed = failed_seeds(result, options.folder);
  if (failed.empty()) return;
  if (failed.size() > kFailureRecordingsMax) {
    recordings.left_out = failed.size() - kFailureRecordingsMax;
    failed.resize(kFailureRecordingsMax);
  }
  std::error_code error;
  if (!options.interrupted) fs::create_directories(options.folder, error);
  std::vector<FailedSeed> repeated;
  for (const FailedSeed& seed : failed) {
    std::string problem = options.interrupted ? "interrupted before the recording began"
                          : error ? options.folder + " cannot be made: " + io::write_error_text(error.value())
                                  : io::OutputFile::problem(seed.file);
    if (problem.empty()) {
      std::error_code missing;
      fs::remove(seed.file, missing);  // else a repeat that crashes early would leave the file of an earlier call
      repeated.push_back(seed);
    }
    seed.outcome->recording_problem = std::move(problem);
  }
  const auto repeat = [&](std::size_t index, io::JobProgressReporter share) {
    const FailedSeed& seed = repeated[index];
    return to_bytes(run_seed(*seed.scenario, seed.outcome->seed,
                             {.progress = [&](double part) { share.set(part); }, .recording = request_of(seed)}));
  };
  const auto jobs =
      io::run_jobs(repeated.size(), repeat,
                   {.jobs = options.jobs, .stop_fd = options.stop_fd, .watch = [&](const io::JobProgress& p) {
                      if (options.on_progress) options.on_progress(p, failed.size() + recordings.left_out);
                    }});
  for (std::size_t i = 0; i < jobs.size(); ++i) take_recording(repeated[i], jobs[i]);
}

}  // namespace tandem::netsim
