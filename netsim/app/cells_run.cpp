#include "netsim/app/cells_run.h"

#include <algorithm>

namespace tandem::netsim {

std::size_t CellsRun::finished() const noexcept {
  return static_cast<std::size_t>(std::ranges::count_if(results, [](const auto& r) { return r.has_value(); }));
}

bool CellsRun::good() const noexcept {
  return std::ranges::all_of(results, [](const auto& r) { return r.has_value() && r->sound(); });
}

CellResult run_cell(const LoadedCells& loaded, const Cell& cell, const std::function<void(double share)>& share) {
  CellResult result;
  for (std::uint64_t s = 0; s < loaded.spec.seeds; ++s) {
    result.runs.push_back(measure_cell(cell, loaded.input, loaded.spec.seed + s));
    if (share) share(static_cast<double>(s + 1) / static_cast<double>(loaded.spec.seeds));
  }
  return result;
}

CellsRun run_cells(const LoadedCells& loaded, const CellsRunOptions& options) {
  CellsRun run;
  run.results.resize(loaded.cells.size());
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < loaded.cells.size(); ++i) {
    const std::string* kept = nullptr;
    if (options.journal != nullptr) {
      const auto it = options.journal->finished().find(loaded.cells[i].number);
      if (it != options.journal->finished().end()) kept = &it->second;
    }
    if (kept == nullptr) {
      waiting.push_back(i);
    } else {
      run.results[i] = cell_result_from_bytes(*kept);
      ++run.taken_over;
    }
  }
  io::JobOptions jobs{.jobs = options.jobs, .stop_fd = options.stop_fd, .watch = options.on_progress};
  jobs.keep_going = [&](std::size_t at, const io::JobResult& job) {
    if (job.state != io::JobResult::State::kDone || options.journal == nullptr || !run.journal_problem.empty())
      return run.journal_problem.empty();
    run.journal_problem = options.journal->append(loaded.cells[waiting[at]].number, job.text);
    return run.journal_problem.empty();
  };
  const auto results = io::run_jobs(
      waiting.size(),
      [&](std::size_t at, io::JobProgressReporter reporter) {
        return to_bytes(run_cell(loaded, loaded.cells[waiting[at]], [&](double share) { reporter.set(share); }));
      },
      jobs);
  for (std::size_t at = 0; at < waiting.size(); ++at) {
    const io::JobResult& job = results[at];
    if (job.state == io::JobResult::State::kDone) run.results[waiting[at]] = cell_result_from_bytes(job.text);
    if (job.state == io::JobResult::State::kCrashed)
      run.troubles.push_back("cell " + std::to_string(loaded.cells[waiting[at]].number) + ": " + job.reason);
  }
  return run;
}

}  // namespace tandem::netsim
