#include "netsim/app/sweep_cells.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <optional>

#include "common/base/format.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"
#include "netsim/app/cell_journal.h"
#include "netsim/app/cells_loader.h"
#include "netsim/app/cells_run.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/app/test_progress.h"
#include "netsim/cells/comparison_page.h"
#include "netsim/cells/shipped_cells.h"
#include "proto/text/cells_text.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

namespace tandem::netsim {
namespace {

constexpr const char* kCommand = "tandem-netsim sweep";

/// The output files of a sweep over cells.
struct Outputs {
  io::OutputFile csv, html, figure;

  /// @return the first error; empty: all are open
  std::string open(const SweepCellsArguments& a) {
    if (auto problem = csv.open(a.csv, true); !problem.empty()) return "--csv: " + problem;
    if (auto problem = html.open(a.html, true); !problem.empty()) return "--html: " + problem;
    if (auto problem = figure.open(a.figure, true); !problem.empty()) return "--figure: " + problem;
    return {};
  }
};

void check_files(const SweepCellsArguments& a, io::UsageErrors& mistakes) {
  const std::array<std::pair<const char*, const std::string*>, 4> files{
      {{"--csv", &a.csv}, {"--html", &a.html}, {"--figure", &a.figure}, {"--resume", &a.resume}}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    mistakes.output_file(files[i].first, *files[i].second);
    for (std::size_t k = 0; k < i; ++k)
      if (!files[i].second->empty() && *files[i].second == *files[k].second)
        mistakes.add(std::string(files[i].first) + ": is the same file as " + files[k].first);
  }
  if (a.resume == "-") mistakes.add("--resume: needs a file, not standard output");
  for (const auto& [option, file] : {std::pair{"--html", &a.html}, {"--figure", &a.figure}})
    if (a.cell > 0 && !file->empty())
      mistakes.add(std::string(option) + ": is for all cells; one cell alone (--cell) is printed, and --csv writes it");
  if (a.cell > 0 && !a.resume.empty())
    mistakes.add("--resume: is for all cells; one cell alone (--cell) needs no file");
}

/// Opens the journal. @return the error; empty: it is open, or none is wanted
std::string open_journal(const SweepCellsArguments& a, const LoadedCells& loaded, std::optional<CellJournal>& journal) {
  if (a.resume.empty()) return {};
  const auto program = program_digest();
  if (!program) return program.error();
  auto opened = CellJournal::open(a.resume, {*program, loaded.digest, loaded.cells.size()});
  if (!opened) return opened.error();
  journal.emplace(std::move(*opened));
  return {};
}

/// Shows the progress of all cells on one line; without a terminal, a line every five seconds.
class CellsProgress {
 public:
  explicit CellsProgress(bool quiet)
      : line_(quiet), terminal_(isatty(STDERR_FILENO) != 0), next_s_(terminal_ ? 0 : 1e-3 * line_.interval_ms()) {}
  void show(const io::JobProgress& p) {
    if (!line_.wanted() || (!terminal_ && p.elapsed_s < next_s_)) return;
    next_s_ = p.elapsed_s + 1e-3 * line_.interval_ms();
    line_.show(format("%3.0f %%  %zu of %zu cells done", 100 * p.share, p.done, p.count) + left_text(p));
  }
  void end() { line_.clear(); }

 private:
  io::StatusLine line_;
  bool terminal_;
  double next_s_;  ///< elapsed time of the next line
};

void report_troubles(const CellsRun& run) {
  constexpr std::size_t kTroubledCellsShown = 5;
  for (std::size_t i = 0; i < std::min(kTroubledCellsShown, run.troubles.size()); ++i)
    io::print(stderr, std::string(kCommand) + ": " + run.troubles[i] + "\n");
  if (run.troubles.size() > kTroubledCellsShown)
    io::print(stderr, format("%s: and %zu more cells crashed\n", kCommand, run.troubles.size() - kTroubledCellsShown));
}

}  // namespace

int sweep_cells(const SweepCellsArguments& a) {
  io::UsageErrors mistakes;
  check_files(a, mistakes);
  auto loaded = load_cells(a.cells);
  if (!loaded) {
    mistakes.add(to_text(loaded.error()));
  } else if (a.cell > static_cast<double>(loaded->cells.size())) {
    mistakes.add(
        format("--cell: %.0f is out of range: %s has cells 1 to %zu", a.cell, a.cells.c_str(), loaded->cells.size()));
  }
  if (!mistakes.empty()) return mistakes.report_each(kCommand);
  if (a.cell > 0) loaded->cells = {loaded->cells[static_cast<std::size_t>(a.cell) - 1]};

  const SignalWatcher interruption;
  std::optional<CellJournal> journal;
  if (const auto problem = open_journal(a, *loaded, journal); !problem.empty())
    return io::report_usage_error(kCommand, "--resume: " + problem);
  Outputs outputs;
  if (const auto problem = outputs.open(a); !problem.empty()) return io::report_usage_error(kCommand, problem);

  CellsProgress progress{a.quiet};
  CellsRun run = run_cells(*loaded, {.jobs = static_cast<std::size_t>(a.jobs),
                                     .stop_fd = interruption.fd(),
                                     .journal = journal ? &*journal : nullptr,
                                     .on_progress = [&](const io::JobProgress& p) { progress.show(p); }});
  progress.end();
  const bool good = run.good(), interrupted = !run.complete() && interruption.signalled();
  const std::size_t finished = run.finished();
  const ComparisonResult comparison{.typed = loaded->typed,
                                    .spec = std::move(loaded->spec),
                                    .cells = std::move(loaded->cells),
                                    .results = std::move(run.results)};
  const bool on_stdout = a.csv == "-" || a.html == "-" || a.figure == "-";
  if (!a.quiet || !on_stdout)
    io::print(on_stdout ? stderr : stdout, a.cell > 0 ? cell_text(comparison, 0) : comparison_text(comparison));
  report_troubles(run);
  if (interrupted) {
    SignalWatcher::report("sweep", format("%zu of %zu cells", finished, comparison.cells.size()));
    if (!a.resume.empty())
      io::print(stderr,
                std::string(kCommand) + ": " + a.resume + " has the finished cells; the same command continues\n");
  }
  outputs.csv.write(comparison_csv(comparison));
  if (outputs.html.is_open()) outputs.html.write(comparison_page(comparison, TANDEM_VERSION));
  if (outputs.figure.is_open()) outputs.figure.write(plot::to_svg_file(laws_figure(comparison)));
  return exit_status(kCommand, {run.journal_problem, outputs.csv.close(), outputs.html.close(), outputs.figure.close()},
                     good && !interrupted);
}

int list_shipped_cells() {
  for (const EmbeddedFile& file : shipped_cells()) {
    const auto spec = parse_cells_text(file.text, std::string(file.name) + ".textproto");
    io::print(stdout, format("%-20s %6zu cells  ", std::string(file.name).c_str(), spec ? spec->cells() : 0) +
                          std::string(file.summary) + "\n");
  }
  return io::kExitDone;
}

}  // namespace tandem::netsim
