#include "netsim/demo/app/run_demo.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <tuple>
#include <utility>

#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "netsim/demo/animation.h"
#include "netsim/demo/app/console_beside.h"
#include "netsim/demo/app/host_info.h"
#include "netsim/demo/app/joint_torques.h"
#include "netsim/demo/app/live_run.h"
#include "netsim/demo/app/progress.h"
#include "netsim/demo/app/quick_run.h"
#include "netsim/demo/app/read_report.h"
#include "netsim/demo/app/repeat_commands.h"
#include "netsim/demo/comparison.h"
#include "netsim/demo/figures.h"
#include "netsim/demo/headline.h"
#include "netsim/demo/html_report.h"
#include "netsim/demo/measure.h"
#include "netsim/demo/overlay.h"
#include "netsim/demo/text_table.h"

namespace tandem::netsim::demo {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void watch_signals() {
  struct sigaction action{};
  action.sa_handler = [](int) { stop = true; };
  sigemptyset(&action.sa_mask);
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) sigaction(s, &action, nullptr);
}

int trouble(const std::string& what) {
  io::print_formatted(stderr, "tandem-demo: %s\n", what.c_str());
  return io::kExitTrouble;
}

/// Returns the files of a run that the demo or its programs wrote.
std::vector<fs::path> files_of(const RunPlan& plan, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* ending : {".json", ".csv", "-server.log", "-netsim.log", "-trainer.log", "-trainee.log",
                             "-trainer.csv", "-trainee.csv", "-trainer.json", "-trainee.json", "-network.csv"})
    files.push_back(folder / (std::string(plan.name) + ending));
  return files;
}

/// @return the error; empty if every byte was written
std::string write_file(const fs::path& path, const std::string& text) {
  io::OutputFile file;
  if (std::string problem = file.open(path.string(), false); !problem.empty()) return problem;
  file.write(text);
  return file.close();
}

/// Reads report and trace of a run, measures numbers and draws figures.
std::expected<RunResult, std::string> digest(const RunPlan& plan, const RawRun& raw,
                                             std::vector<std::string> commands) {
  auto report = read_report(raw.json);
  if (!report) return std::unexpected(report.error());
  auto trace = read_trace(raw.trace);
  if (!trace) return std::unexpected(trace.error());
  for (const auto& [text, own, seat] : {std::tuple{&raw.trainer, &trace->trainer_own, &trace->trainer},
                                        std::tuple{&raw.trainee, &trace->trainee_own, &trace->trainee}}) {
    if (text->empty()) continue;
    auto samples = read_samples(*text);
    if (!samples) return std::unexpected(samples.error());
    *own = std::move(*samples);
    put_samples(trace->t, *own, *seat);
  }
  add_joint_torques(*trace);
  for (const std::string* client : {&raw.trainer_json, &raw.trainee_json})
    if (!client->empty()) report->late_ticks += read_late_ticks(*client);
  return RunResult{.plan = &plan,
                   .report = std::move(*report),
                   .trace = measure(plan, *trace),
                   .springs = springs_of(plan),
                   .commands = std::move(commands),
                   .figures_html = figures_html(plan, *trace),
                   .overlay = overlay_series(plan, *trace),
                   .network = raw.network,
                   .motion = motion_frames(*trace)};
}

struct Folders {
  fs::path files, report;
  bool temporary = false;  ///< remove the files after success
};

std::expected<Folders, std::string> folders_of(const DemoOptions& plan) {
  Folders f;
  f.files = plan.out.empty() ? fs::path("demo-output") : fs::path(plan.out);
  f.report = plan.out.empty() ? fs::path("report.html") : f.files / "report.html";
  f.temporary = plan.out.empty() && !plan.keep;
  std::error_code error;
  fs::create_directories(f.files, error);
  if (error) return std::unexpected(f.files.string() + " cannot be made: " + error.message());
  // Checked before the runs, which take two minutes.
  if (const std::string problem = io::OutputFile::problem(f.report.string()); !problem.empty())
    return std::unexpected(problem);
  return f;
}

void remove_files(const DemoOptions& plan, const Folders& folders) {
  std::error_code ignored;
  for (const RunPlan* run : plan.runs)
    for (const fs::path& file : files_of(*run, folders.files)) fs::remove(file, ignored);
  fs::remove(folders.files / ConsoleBeside::kLog, ignored);
  fs::remove(folders.files, ignored);  // removes it only if empty
}

/// Prints the broken invariants of the runs. @return number of failed runs
std::size_t count_failed(const std::vector<RunResult>& results) {
  std::size_t failed = 0;
  for (const RunResult& run : results) {
    if (run.report.passed) continue;
    ++failed;
    for (const ViolationNumbers& v : run.report.violations)
      if (!v.expected)
        io::print_formatted(stderr, "tandem-demo: %s: broken invariant %s %s at %.3f s\n",
                            std::string(run.plan->name).c_str(), v.invariant.c_str(), v.seat.c_str(), v.at_s);
  }
  return failed;
}

}  // namespace

int run_demo(const DemoOptions& plan) {
  watch_signals();
  const auto folders = folders_of(plan);
  if (!folders) return trouble(folders.error());
  const DemoPaths places{own_folder(), folders->files};
  if (!plan.quick) {
    const std::string missing = missing_programs(places);
    if (!missing.empty())
      return trouble("missing: " + missing + ". Build them, or use --quick: virtual time needs no other program");
  }
  io::print_formatted(
      stdout, "Tandem: two people, one tool. %zu run%s %s.\n", plan.runs.size(), plan.runs.size() == 1 ? "" : "s",
      plan.quick ? "in virtual time"
                 : "in real time over UDP on loopback: a server, two clients and the network simulator");

  Progress progress(plan.runs, plan.quick ? 60 : 1);
  std::optional<ConsoleBeside> console;
  if (plan.console && !plan.quick) console.emplace(places);
  RunObserver observer{[&](double session_s) {
                         if (const auto line = console ? console->poll() : std::nullopt) {
                           progress.clear();
                           io::print_formatted(stdout, "%s\n", line->c_str());
                           std::fflush(stdout);
                         }
                         progress.at(session_s);
                       },
                       &stop};
  if (console)
    observer.listening = [&](const std::string& address) {
      observer.listen = address;  // of the next servers too, so that the console finds them
      console->on_server(address);
    };
  const char* search_path = std::getenv("PATH");
  const std::string prefix =
      program_prefix(places.programs, fs::current_path(), search_path == nullptr ? "" : search_path);
  std::vector<RunResult> results;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const RunPlan& run = *plan.runs[k];
    progress.begin(k);
    const auto raw = plan.quick ? quick_run(run, observer) : live_run(run, places, observer);
    if (!raw) {
      progress.clear();
      if (stop) {
        io::print_formatted(stderr, "tandem-demo: interrupted; every program it started has ended\n");
        if (folders->temporary) remove_files(plan, *folders);
        return io::kExitInterrupted;
      }
      return trouble(title_of(run) + ": " + raw.error());
    }
    if (plan.quick && !folders->temporary)
      for (const auto& [ending, text] : {std::pair{".json", &raw->json}, {".csv", &raw->trace}})
        if (const std::string problem = write_file(folders->files / (std::string(run.name) + ending), *text);
            !problem.empty())
          return trouble(problem);
    auto result = digest(run, *raw, plan.quick ? virtual_commands(run, prefix) : real_commands(run, prefix));
    if (!result) {
      progress.clear();
      return trouble(title_of(run) + ": " + result.error());
    }
    results.push_back(std::move(*result));
    progress.end();
  }

  const Comparison comparison = compare(results);
  const char* no_colour = std::getenv("NO_COLOR");
  const bool colour = isatty(STDOUT_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
  std::printf("\n%s", to_text(comparison, colour, io::text_width(stdout).value_or(kTextWidth)).c_str());
  const RunInfo where{!plan.quick, date_text(), host_text(), plan.version, plan.repeat};
  io::print_formatted(stdout, "%s\nBad network: %s. ✓ ✗: within what is asked, or not; %zu missed.\n",
                      where.machine.c_str(), network_text(Setting::kBadNetwork).c_str(), comparison.missed);
  const Headline headline = headline_of(results, comparison);
  io::print_formatted(stdout, "%s\n", headline.sentence.c_str());
  if (!headline.disturbed.empty()) io::print_formatted(stdout, "%s\n", headline.disturbed.c_str());
  if (const std::string problem = write_file(folders->report, html_report(results, comparison, where));
      !problem.empty())
    return trouble(problem);
  const std::size_t failed = count_failed(results);
  if (folders->temporary && failed == 0) {
    remove_files(plan, *folders);
  } else {
    io::print_formatted(stdout, "Traces and reports of the runs: %s\n", folders->files.string().c_str());
  }
  std::printf("%s\n", file_link(folders->report).c_str());
  return failed == 0 ? io::kExitDone : io::kExitTrouble;
}

}  // namespace tandem::netsim::demo
