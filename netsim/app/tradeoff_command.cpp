#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>
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
  std::string scene, ticks, substeps, csv, svg;
  bool all = false, no_times = false, no_instructions = false, quiet = false, worker = false;
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

int tradeoff_command(const TradeoffArguments& a) {
  io::UsageErrors mistakes;
  const tradeoff::Grid grid = grid_of(a, mistakes);
  SceneSpec scene;
  if (auto read = load_scene(a.scene)) {
    scene = std::move(*read);
    if (!scene.tools[0].is_virtual)
      mistakes.add("the first tool of " + a.scene +
                   " is moved with a device; numerics are those of a simulated tool: name a scene whose first tool has "
                   "slave { model: VIRTUAL }, such as contact");
  } else {
    mistakes.add(to_text(read.error()));
  }
  for (const auto& [option, file] : {std::pair{"--csv", &a.csv}, {"--svg", &a.svg}})
    mistakes.output_file(option, *file);
  if (!a.csv.empty() && a.csv == a.svg) mistakes.add("--svg: is the same file as --csv");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim tradeoff");
  if (a.worker) return run_cost_worker(tradeoff::tool_task(scene), grid.substeps);

  const SignalWatcher interruption;
  io::OutputFile csv_file, svg_file;
  if (const auto problem = csv_file.open(a.csv, true); !problem.empty())
    return io::report_usage_error("tandem-netsim tradeoff", "--csv: " + problem);
  if (const auto problem = svg_file.open(a.svg, true); !problem.empty())
    return io::report_usage_error("tandem-netsim tradeoff", "--svg: " + problem);
  io::StatusLine line{a.quiet || isatty(STDERR_FILENO) == 0};
  if (line.wanted()) line.show("counting instructions under callgrind");
  CostTable costs(tradeoff::tool_task(scene), grid.substeps, !a.no_times);
  std::vector<std::string> notes;
  if (a.no_instructions) {
    notes.emplace_back("instructions: not measured (--no-instructions)");
  } else if (const std::string problem = costs.count_instructions(a.scene, a.substeps, interruption.fd());
             !problem.empty()) {
    notes.push_back("instructions: not measured, " + problem);
  }
  if (!costs.has_instructions())
    notes.emplace_back("work per second of the Pareto front and of the advice: steps of the tool, whatever they cost");

  tradeoff::Tradeoff result = run_tradeoff(
      scene, grid, [&](const control::Numerics& numerics) { return costs.of(numerics); },
      [&](std::size_t done, std::size_t count) {
        if (line.wanted() && done % 8 == 0)
          line.show(format("%3.0f %%  %zu of %zu choices measured",
                           100.0 * static_cast<double>(done) / static_cast<double>(count), done, count));
        return !interruption.signalled();
      });
  line.clear();
  result.scene = a.scene;
  result.notes = std::move(notes);
  const bool on_stdout = a.csv == "-" || a.svg == "-";
  if (!a.quiet || !on_stdout) io::print(on_stdout ? stderr : stdout, tradeoff_text(result, a.all, !a.no_times));
  if (result.interrupted) SignalWatcher::report("tradeoff", format("%zu choices", result.rows.size()));
  csv_file.write(tradeoff_csv(result, !a.no_times));
  svg_file.write(tradeoff_svg(result));
  return exit_status("tandem-netsim tradeoff", {csv_file.close(), svg_file.close()}, !result.interrupted);
}

}  // namespace

void add_tradeoff_command(const io::Command& root) {
  const auto [command, a] = root.add_command(
      "tradeoff", "Measures what the numerics of a scene's simulated tool cost, and how exact they are.",
      tradeoff_command);
  command
      .add_option("scene", a.scene,
                  "a scene file, or the name of a shipped scene; mass, damping and surfaces of its first tool and the "
                  "hand's spring are used")
      .value_name(" ")
      .required();
  command.add_option("--tick-hz", a.ticks, "tick rates [Hz], 100 to 10000; default 100,200,500,1000,2000,5000,10000")
      .value_name("HZ,HZ,...");
  command.add_option("--substeps", a.substeps, "steps per tick, 1 to 64; default 1,4,16").value_name("N,N,...");
  command.add_flag("--all", a.all, "prints all rows, not only the Pareto front");
  command.add_flag("--no-times", a.no_times, "without the columns in ns; the rest is the same in every run");
  command.add_flag("--no-instructions", a.no_instructions, "does not run callgrind");
  command.add_flag("--under-callgrind", a.worker,
                   "takes only the steps that are counted; the command starts itself with this flag under callgrind");
  command.add_option("--csv", a.csv, "writes one line per row; `-`: to standard output").value_name("FILE|-");
  command.add_option("--svg", a.svg, "draws the force error over the work; `-`: to standard output")
      .value_name("FILE|-");
  command.add_flag("--quiet", a.quiet, "no progress, and no table beside --csv - or --svg -");
  command.footer(
      "Every integrator of the scene's numerics { }, in double and float, does the same task of one second. Errors "
      "are\n"
      "RMS over the ticks against a reference in long double. \"Of it by step\" is the error against a reference "
      "whose\n"
      "hand is held within a tick, as the tool sees it. \"Stiffest\" is the stiffest spring with stable steps.\n"
      "Instructions are counted if valgrind is installed.\n\n"
      "Exit: 0 measured, 1 interrupted or a file could not be written, 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim tradeoff contact\n"
      "  tandem-netsim tradeoff contact --all --no-times --csv numerics.csv --svg numerics.svg\n"
      "  tandem-netsim tradeoff one_axis --tick-hz 500,1000 --substeps 1,2 --no-instructions");
}

}  // namespace tandem::netsim
