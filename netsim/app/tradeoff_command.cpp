#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/app/sweep.h"
#include "netsim/app/tradeoff_cost.h"
#include "netsim/tradeoff/tradeoff.h"
#include "proto/io/scene_file.h"

namespace tandem::netsim {
namespace {

struct TradeoffArguments {
  std::string scene, ticks, substeps, csv, svg, html;
  bool tool_only = false, all = false, no_times = false, no_instructions = false, quiet = false, worker = false;
};

/// Reads the lists of the grid; collects all errors.
tradeoff::Grid grid_of(const TradeoffArguments& a, io::UsageErrors& mistakes) {
  tradeoff::Grid grid;
  const auto read = [&](const char* option, const std::string& text, double lo, double hi, const char* unit) {
    auto values = parse_axis(text, lo, hi, unit);
    if (!values) mistakes.add(std::string(option) + ": " + values.error());
    return values ? *values : std::vector<double>{};
  };
  if (!a.ticks.empty()) grid.ticks_hz = read("--tick-hz", a.ticks, 100, 10'000, "Hz");
  if (!a.substeps.empty()) {
    grid.substeps.clear();
    for (const double value : read("--substeps", a.substeps, 1, control::kSubstepsMax, "1")) {
      if (value != std::floor(value)) mistakes.add(format("--substeps: %g is not a whole number", value));
      grid.substeps.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return grid;
}

/// The words that choose what is measured, for callgrind's process.
std::vector<std::string> words_of(const TradeoffArguments& a) {
  std::vector<std::string> words{a.scene};
  if (!a.ticks.empty()) words.insert(words.end(), {"--tick-hz", a.ticks});
  if (!a.substeps.empty()) words.insert(words.end(), {"--substeps", a.substeps});
  if (a.tool_only) words.emplace_back("--tool-only");
  return words;
}

int tradeoff_command(const TradeoffArguments& a) {
  io::UsageErrors mistakes;
  const tradeoff::Grid grid = grid_of(a, mistakes);
  SceneSpec scene;
  if (auto read = load_scene(a.scene)) {
    scene = std::move(*read);
    if (a.tool_only && !scene.tools[0].is_virtual)
      mistakes.add("--tool-only: the first tool of " + a.scene +
                   " is moved with a device; name a scene whose first tool has slave { model: VIRTUAL }, such as "
                   "contact, or leave the option out");
  } else {
    mistakes.add(to_text(read.error()));
  }
  const std::array outputs{std::pair{"--csv", &a.csv}, std::pair{"--svg", &a.svg}, std::pair{"--html", &a.html}};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    mistakes.output_file(outputs[i].first, *outputs[i].second);
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[i].second->empty() && *outputs[i].second == *outputs[j].second)
        mistakes.add(format("%s: is the same file as %s", outputs[i].first, outputs[j].first));
  }
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim tradeoff");
  const std::vector<tradeoff::ModelChoice> tiers =
      a.tool_only ? std::vector<tradeoff::ModelChoice>{} : tradeoff::tier_choices(scene);
  const std::vector<tradeoff::ModelChoice> devices =
      a.tool_only ? std::vector<tradeoff::ModelChoice>{}
                  : tradeoff::device_choices(scene, grid.ticks_hz, grid.substeps);
  CostSubjects subjects{.tool = {}, .substeps = grid.substeps, .models = tiers};
  if (scene.tools[0].is_virtual) subjects.tool = tradeoff::tool_task(scene);
  subjects.models.insert(subjects.models.end(), devices.begin(), devices.end());
  if (a.worker) return run_cost_worker(subjects);

  const SignalWatcher interruption;
  std::array<io::OutputFile, 3> files;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (const auto problem = files[i].open(*outputs[i].second, true); !problem.empty())
      return io::report_usage_error("tandem-netsim tradeoff", std::string(outputs[i].first) + ": " + problem);
  io::StatusLine line{a.quiet || isatty(STDERR_FILENO) == 0};
  if (line.wanted()) line.show("counting instructions under callgrind");
  CostTable costs(std::move(subjects), !a.no_times);
  std::vector<std::string> notes;
  if (a.no_instructions) {
    notes.emplace_back("instructions: not measured (--no-instructions)");
  } else if (const std::string problem = costs.count_instructions(words_of(a), interruption.fd()); !problem.empty()) {
    notes.push_back("instructions: not measured, " + problem);
  }
  if (!costs.has_instructions())
    notes.emplace_back(
        "work per second of the Pareto front and of the advice: steps of tool or device, whatever they cost");

  std::size_t rows_before = 0;
  const std::size_t models = tiers.size() + devices.size();
  const auto go_on = [&](std::size_t done, std::size_t count) {
    if (line.wanted() && done % 8 == 0)
      line.show(format("%3.0f %%  %zu of %zu choices measured",
                       100.0 * static_cast<double>(done) / static_cast<double>(count), done, count));
    return !interruption.signalled();
  };
  tradeoff::Tradeoff result = run_tradeoff(
      scene, grid, [&](const control::Numerics& numerics) { return costs.of(numerics); },
      [&](std::size_t done, std::size_t count) { return go_on(done, count + models); });
  const auto measured = [&](const std::vector<tradeoff::ModelChoice>& choices, std::size_t first) {
    if (result.interrupted) return std::vector<tradeoff::ModelRow>{};
    const auto begin = costs.models().begin() + static_cast<std::ptrdiff_t>(first);
    auto rows =
        measure_models(choices, {begin, begin + static_cast<std::ptrdiff_t>(choices.size())},
                       [&](std::size_t done) { return go_on(rows_before + done, rows_before + models - first); });
    rows_before += rows.size();
    result.interrupted = rows.size() < choices.size();
    return rows;
  };
  rows_before = result.rows.size();
  result.tiers = measured(tiers, 0);
  if (!result.interrupted) compare_tiers(result.tiers);
  result.devices = measured(devices, tiers.size());
  mark_pareto(result.devices);
  line.clear();
  result.scene = a.scene;
  result.notes = std::move(notes);
  const bool on_stdout = a.csv == "-" || a.svg == "-" || a.html == "-";
  if (!a.quiet || !on_stdout) io::print(on_stdout ? stderr : stdout, tradeoff_text(result, a.all, !a.no_times));
  if (result.interrupted) SignalWatcher::report("tradeoff", format("%zu choices", rows_before));
  if (!a.csv.empty()) files[0].write(tradeoff_csv(result, !a.no_times));
  if (!a.svg.empty()) files[1].write(tradeoff_svg(result));
  if (!a.html.empty()) files[2].write(tradeoff_page(result, !a.no_times, TANDEM_VERSION));
  return exit_status("tandem-netsim tradeoff", {files[0].close(), files[1].close(), files[2].close()},
                     !result.interrupted);
}

}  // namespace

void add_tradeoff_command(const io::Command& root) {
  const auto [command, a] = root.add_command(
      "tradeoff", "Measures what models and numerics of a scene's tool and devices cost, and how exact they are.",
      tradeoff_command);
  command
      .add_option(
          "scene", a.scene,
          "a scene file, or the name of a shipped scene; its first tool with its surfaces, the hand's spring and "
          "one device are used")
      .value_name(" ")
      .required();
  command.add_option("--tick-hz", a.ticks, "tick rates [Hz], 100 to 10000; default 100,200,500,1000,2000,5000,10000")
      .value_name("HZ,HZ,...");
  command.add_option("--substeps", a.substeps, "steps per tick, 1 to 64; default 1,4,16").value_name("N,N,...");
  command.add_flag("--all", a.all, "prints all rows, not only the Pareto front");
  command.add_flag("--no-times", a.no_times, "without the columns in ns; the rest is the same in every run");
  command.add_flag("--no-instructions", a.no_instructions, "does not run callgrind");
  command.add_flag("--tool-only", a.tool_only, "only the numerics of the simulated tool: neither device nor models");
  // The command starts itself with this flag under callgrind. An empty heading hides it.
  command.add_flag("--under-callgrind", a.worker, "takes only the steps that are counted").group("");
  command.add_option("--csv", a.csv, "writes one line per row; `-`: to standard output").value_name("FILE|-");
  command.add_option("--svg", a.svg, "draws the force error over the work; `-`: to standard output")
      .value_name("FILE|-");
  command.add_option("--html", a.html, "writes tables and figures as one page; `-`: to standard output")
      .value_name("FILE|-");
  command.add_flag("--quiet", a.quiet, "no progress, and no table beside a file on standard output");
  command.footer(
      "Every integrator of the scene's numerics { }, in double and float, does the same task of one second; so does "
      "the\n"
      "first tool's device, or that of the first seat, with its own numerics { }; and so do simpler and fuller "
      "models.\n"
      "Errors are RMS over the ticks against a reference in long double. \"Of it by step\" is the error against a "
      "reference "
      "whose\n"
      "hand is held within a tick, as the tool sees it. \"Stiffest\" is the stiffest spring with stable steps.\n"
      "Instructions are counted if valgrind is installed.\n\n"
      "Exit: 0 measured, 1 interrupted or a file could not be written, 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim tradeoff contact\n"
      "  tandem-netsim tradeoff contact --all --no-times --csv numerics.csv --html numerics.html\n"
      "  tandem-netsim tradeoff one_axis --tick-hz 500,1000 --substeps 1,2 --no-instructions");
}

}  // namespace tandem::netsim
