#include <array>
#include <cstdio>
#include <limits>

#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/failure_recordings.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/scenario_loader.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/app/test_progress.h"
#include "netsim/app/test_report.h"
#include "netsim/scenario/shipped_scenarios.h"
#include "netsim/system/session_notes.h"

namespace tandem::netsim {
namespace {

constexpr double kJobsMax = 256, kSeedsMax = 100'000;

struct TestArguments {
  io::Command command;
  std::vector<std::string> scenarios;
  std::uint64_t seed = 1;
  double seeds = 1, jobs = 0;
  std::string junit, json, trace, record_failures;
  bool fail_fast = false, list = false, check = false, reports = false, quiet = false;
};

int test_usage_error(const std::string& mistake) { return io::report_usage_error("tandem-netsim test", mistake); }

void list(const std::vector<Scenario>& scenarios) {
  std::size_t width = 0;
  for (const Scenario& s : scenarios) width = std::max(width, s.name.size());
  for (const Scenario& s : scenarios)
    io::print_formatted(stdout, "%-*s  %3u seed%s  %5.0f s  %s\n", static_cast<int>(width), s.name.c_str(), s.seeds,
                        s.seeds == 1 ? " " : "s", s.setup.scene.duration, s.summary.c_str());
}

/// Checks the options that depend on the scenarios.
void check_together(const TestArguments& a, const std::vector<Scenario>& scenarios, io::UsageErrors& mistakes) {
  std::uint64_t runs = 0;
  for (const Scenario& s : scenarios) {
    const std::uint64_t seeds = a.command.given("--seeds") ? static_cast<std::uint64_t>(a.seeds) : s.seeds;
    const std::uint64_t first = a.command.given("--seed") ? a.seed : s.seed;
    runs += seeds;
    if (first > std::numeric_limits<std::uint64_t>::max() - (seeds - 1))
      mistakes.add(s.name + ": seed " + std::to_string(first) + " and " + std::to_string(seeds - 1) +
                   " more are beyond 64 bits");
  }
  if (!a.trace.empty() && runs != 1)
    mistakes.add("--trace: is of one seed of one scenario, these are " + std::to_string(runs) +
                 "; add --seeds 1 and name one");
}

void check_outputs(const TestArguments& a, io::UsageErrors& mistakes) {
  const std::array<std::pair<const char*, const std::string*>, 3> files{
      {{"--json", &a.json}, {"--junit", &a.junit}, {"--trace", &a.trace}}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [option, file] = files[i];
    if (file->empty() || (*file == "-" && i == 0)) continue;
    if (*file == "-") {
      mistakes.add(std::string(option) + ": standard output is for --json; name a file");
    } else {
      mistakes.add(option, io::OutputFile::problem(*file));
    }
    for (std::size_t k = 0; k < i; ++k)
      if (*files[k].second == *file) mistakes.add(std::string(option) + ": is the same file as " + files[k].first);
  }
}

/// Records the failed seeds. Prints what could not be written; the verdict stays as it is.
void record(const TestArguments& a, const TestOptions& options, bool interrupted, TestResult& result) {
  record_failures(result, {.folder = a.record_failures,
                           .jobs = options.jobs,
                           .stop_fd = options.stop_fd,
                           .interrupted = interrupted,
                           .on_progress = options.on_progress});
  for (const ScenarioResult& r : result.scenarios)
    for (const SeedOutcome& s : r.seeds)
      if (!s.recording_problem.empty())
        io::print(stderr, "tandem-netsim test: --record-failures: " + r.scenario.name + ", seed " +
                              std::to_string(s.seed) + ": " + s.recording_problem + "\n");
}

int test_command(const TestArguments& a) {
  io::UsageErrors mistakes;
  check_outputs(a, mistakes);
  if (!a.record_failures.empty()) mistakes.add("--record-failures", recording_folder_problem(a.record_failures));
  std::vector<std::string> names = a.scenarios;
  if (names.empty() && a.list) names.emplace_back(kAllShipped);
  if (names.empty()) {
    std::string all;
    for (const EmbeddedFile& s : shipped_scenarios()) all += " " + std::string(s.name);
    mistakes.add("SCENARIO is required: a file, a folder, `shipped` for all shipped ones, or one of:" + all);
  }
  for (const auto& [only, wanted] : {std::pair{"--check", a.check}, std::pair{"--list", a.list}})
    for (const auto& [option, file] :
         {std::pair{"--json", &a.json}, std::pair{"--junit", &a.junit}, std::pair{"--trace", &a.trace},
          std::pair{"--record-failures", &a.record_failures}})
      if (wanted && !file->empty())
        mistakes.add(std::string(only) + " runs nothing, so there is nothing for " + option +
                     "; leave one of them out");
  std::vector<std::string> left_out;
  auto scenarios = load_scenarios(names, &left_out);
  if (scenarios) {
    check_together(a, *scenarios, mistakes);
  } else {
    mistakes.add(to_text(scenarios.error()));
  }
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim test");
  for (const std::string& note : left_out) io::print_formatted(stderr, "note: %s\n", note.c_str());
  for (Scenario& s : *scenarios) {  // the options now replace the scenario's values
    if (a.command.given("--seed")) s.seed = a.seed;
    if (a.command.given("--seeds")) s.seeds = static_cast<std::uint32_t>(a.seeds);
  }
  if (a.list) {
    list(*scenarios);
    return io::kExitDone;
  }
  if (a.check) {
    for (const Scenario& s : *scenarios) {
      std::printf("%s%s\n%s", &s == &scenarios->front() ? "" : "\n", s.name.c_str(),
                  effective_scenario_text(s).c_str());
      for (const std::string& note : late_notes(s.setup)) std::printf("note: %s\n", note.c_str());
    }
    std::printf("# OK: %zu scenario%s without a mistake; nothing was started\n", scenarios->size(),
                scenarios->size() == 1 ? "" : "s");
    return io::kExitDone;
  }
  const SignalWatcher interruption;
  io::OutputFile json_file, junit_file;
  if (const auto problem = json_file.open(a.json, true); !problem.empty())
    return test_usage_error("--json: " + problem);
  if (const auto problem = junit_file.open(a.junit, false); !problem.empty())
    return test_usage_error("--junit: " + problem);

  TestProgress progress(a.quiet);
  TestOptions options{.jobs = static_cast<std::size_t>(a.jobs),
                      .fail_fast = a.fail_fast,
                      .reports = a.reports,
                      .trace = a.trace,
                      .stop_fd = interruption.fd()};
  if (a.command.given("--seed")) options.seed = a.seed;
  if (a.command.given("--seeds")) options.seeds = static_cast<std::uint64_t>(a.seeds);
  options.on_progress = [&](const io::JobProgress& p, std::size_t failed) { progress.show(p, failed); };
  TestResult result = run_tests(std::move(*scenarios), options);
  if (!a.record_failures.empty()) record(a, options, interruption.signalled(), result);
  progress.end();
  result.interrupted = result.not_run() > 0 && interruption.signalled();

  const bool json_on_stdout = a.json == "-";
  if (!a.quiet || !json_on_stdout) io::print(json_on_stdout ? stderr : stdout, test_summary(result));
  if (result.interrupted)
    SignalWatcher::report(
        "test", std::to_string(result.all() - result.not_run()) + " of " + std::to_string(result.all()) + " seeds");
  json_file.write(test_json(result));
  junit_file.write(junit_xml(result));
  return exit_status("tandem-netsim test", {json_file.close(), junit_file.close()},
                     !result.interrupted && result.passed());
}

}  // namespace

void add_test_command(const io::Command& root) {
  const auto [command, a] =
      root.add_command("test", "Runs scenarios over many seeds and gives a verdict, for CI.", test_command);
  a.command = command;
  command
      .add_option("SCENARIO", a.scenarios,
                  "scenario files, folders of them, names of shipped ones (--list), or `shipped`: all of these")
      .value_name(" ");
  command.add_option("--seeds", a.seeds, "how many seeds of each scenario, instead of its own number")
      .check(io::whole_number_in(1, kSeedsMax))
      .value_name("N");
  command.add_option("--seed", a.seed, "the first seed, instead of the scenario's")
      .check(io::whole_number())
      .value_name("FIRST");
  command.add_option("--jobs", a.jobs, "seeds that run at a time; default: one per core. No result depends on it")
      .check(io::whole_number_in(1, kJobsMax))
      .value_name("N");
  command.add_option("--junit", a.junit, "writes JUnit XML: one testsuite per scenario, one testcase per seed")
      .value_name("FILE");
  command
      .add_option("--json", a.json,
                  "writes the verdicts; `-`: to standard output. Equal but for the keys cpu_s for equal seeds")
      .value_name("FILE|-");
  command.add_flag("--reports", a.reports, "adds the report of `run --json` for each seed to --json");
  command.add_option("--trace", a.trace, "writes one row per tick; of one seed only").value_name("FILE.csv");
  command
      .add_option("--record-failures", a.record_failures,
                  "repeats each failed seed, at most 20, and records it as DIR/SCENARIO-seed-N.mcap, for `replay`, "
                  "`trace` and viewers; makes DIR")
      .value_name("DIR");
  command.add_flag("--fail-fast", a.fail_fast,
                   "runs nothing after the first seed that fails, in the order of the table");
  command.add_flag("--list", a.list, "only lists scenarios: seeds, length, summary; without SCENARIO the shipped ones");
  command.add_flag("--check", a.check, "only checks the files and prints every value in force, with units");
  command.add_flag("--quiet", a.quiet, "no progress, and no table beside --json -");
  command.footer(
      "A seed passes when no promised invariant is broken (as `run` judges) and every limit of its scenario holds.\n"
      "For each failure the report has the command that repeats the seed, with the same trace_hash, with its "
      "trace.\n"
      "A recording that cannot be written is an error with words; the exit code is that of the verdict.\n\n"
      "Exit: 0 all passed, 1 something failed or was not run (Ctrl-C too), 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim test --list\n"
      "  tandem-netsim test shipped --junit verdict.xml\n"
      "  tandem-netsim test shipped --junit verdict.xml --record-failures failures\n"
      "  tandem-netsim test my-scenarios/ --seeds 100 --jobs 8 --json -\n"
      "  tandem-netsim test outage-one-seat --seed 17 --seeds 1 --trace out.csv");
}

}  // namespace tandem::netsim
