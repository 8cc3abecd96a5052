#include <array>
#include <cstdio>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/law_options.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/app/sweep.h"
#include "netsim/app/sweep_cells.h"
#include "netsim/app/test_progress.h"
#include "netsim/system/session_notes.h"
#include "proto/io/scene_file.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {
namespace {

struct SweepArguments {
  std::string scene, delay, jitter, loss, metric = "tracking_rms_m", channel, coupling, mfs, json, csv;
  std::uint64_t seed = 1;
  double seeds = 1, jobs = 0, duration_s = 0;
  bool quiet = false;
  std::string cells, resume, html, figure;
  double cell = 0;
  bool list = false;
};

int sweep_usage_error(const std::string& mistake) { return io::report_usage_error("tandem-netsim sweep", mistake); }

/// Makes the sweep from the arguments; collects all errors.
SweepSpec understand(const SweepArguments& a, io::UsageErrors& mistakes) {
  SweepSpec spec;
  spec.scene_name = a.scene;
  spec.metric = a.metric;
  if (auto scene = load_scene(a.scene)) {
    spec.scene = std::move(*scene);
  } else {
    mistakes.add(to_text(scene.error()));
  }
  const auto axis = [&](const char* option, const std::string& text, double hi, const char* unit,
                        std::vector<double>& into) {
    if (text.empty()) return;
    if (auto values = parse_axis(text, 0, hi, unit)) {
      into = std::move(*values);
    } else {
      mistakes.add(std::string(option) + ": " + values.error());
    }
  };
  axis("--delay", a.delay, 60'000, "ms", spec.delays_ms);
  axis("--jitter", a.jitter, 60'000, "ms", spec.jitters_ms);
  axis("--loss", a.loss, 100, "%", spec.losses_percent);
  if (a.delay.empty() && a.jitter.empty() && a.loss.empty())
    mistakes.add("nothing to sweep: give at least one of --delay, --jitter, --loss, such as --delay 0,20,50");
  const std::size_t points = spec.delays_ms.size() * spec.jitters_ms.size() * spec.losses_percent.size();
  if (points > kSweepPointsMax)
    mistakes.add("the grid has " + std::to_string(points) + " points; at most " + std::to_string(kSweepPointsMax) +
                 " are allowed");
  if (const auto known = sweep_metric(a.metric); !known) mistakes.add("--metric: " + known.error());
  if (a.duration_s <= 0 && !spec.scene.seats.empty() && spec.scene.endless())
    mistakes.add("--duration: " + endless_scene_error(a.scene, "give --duration S, such as --duration 60"));
  if (a.duration_s > 0) {
    spec.scene.duration = a.duration_s;
    spec.options += format("--duration %.9g", a.duration_s);
  }
  if (const auto of = sweep_metric(a.metric)) {
    const auto touches = [&](const PhaseSpec& p) { return p.contact && p.from < spec.scene.duration; };
    if (!spec.scene.seats.empty() && known_metric(*of, a.metric)->needs_contact &&
        !std::ranges::any_of(spec.scene.phases, touches))
      mistakes.add("--metric: " + a.metric +
                   " is measured in phases that the scene marks `contact: true`; the run of " + a.scene + " has none");
  }
  const auto add = [&](const std::string& option) { spec.options += (spec.options.empty() ? "" : " ") + option; };
  set_coupling(spec.scene, a.coupling);
  set_law(spec.scene, a.channel, a.mfs);
  if (!a.channel.empty()) add("--channel " + a.channel);
  if (!a.coupling.empty()) add("--coupling " + a.coupling);
  if (!a.mfs.empty()) add("--mfs " + a.mfs);
  mistakes.add(law_option(a.channel, a.coupling), law_conflict(spec.scene, a.scene));
  return spec;
}

/// Runs the cells of a file; rejects options of a map.
int sweep_of_cells(const SweepArguments& a) {
  io::UsageErrors mistakes;
  const auto excluded = [&](const char* option, bool given) {
    if (given) mistakes.add(std::string(option) + ": is for a map of one scene; the file of --cells decides it");
  };
  excluded("scene", !a.scene.empty());
  excluded("--delay", !a.delay.empty());
  excluded("--jitter", !a.jitter.empty());
  excluded("--loss", !a.loss.empty());
  excluded("--metric", a.metric != SweepArguments{}.metric);
  excluded("--seed", a.seed != 1);
  excluded("--seeds", a.seeds != 1);
  excluded("--duration", a.duration_s > 0);
  excluded("--channel", !a.channel.empty());
  excluded("--coupling", !a.coupling.empty());
  excluded("--mfs", !a.mfs.empty());
  if (!a.json.empty()) mistakes.add("--json: is for a map of one scene; with --cells use --csv or --html");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim sweep");
  return sweep_cells({.cells = a.cells,
                      .resume = a.resume,
                      .csv = a.csv,
                      .html = a.html,
                      .figure = a.figure,
                      .cell = a.cell,
                      .jobs = a.jobs,
                      .quiet = a.quiet});
}

int sweep_command(const SweepArguments& a) {
  if (a.list) return list_shipped_cells();
  if (!a.cells.empty()) return sweep_of_cells(a);
  io::UsageErrors mistakes;
  if (a.scene.empty())
    mistakes.add("nothing to sweep: name a scene, or a file of cells by --cells, such as --cells comparison");
  for (const auto& [option, given] : {std::pair{"--cell", a.cell > 0},
                                      {"--resume", !a.resume.empty()},
                                      {"--html", !a.html.empty()},
                                      {"--figure", !a.figure.empty()}})
    if (given) mistakes.add(std::string(option) + ": is for a file of cells; add --cells FILE");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim sweep");
  SweepSpec spec = understand(a, mistakes);
  for (const auto& [option, file] : {std::pair{"--json", &a.json}, {"--csv", &a.csv}})
    mistakes.output_file(option, *file);
  if (!a.json.empty() && a.json == a.csv) mistakes.add("--csv: is the same file as --json");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim sweep");

  const SignalWatcher interruption;
  io::OutputFile json_file, csv_file;
  if (const auto problem = json_file.open(a.json, true); !problem.empty())
    return sweep_usage_error("--json: " + problem);
  if (const auto problem = csv_file.open(a.csv, true); !problem.empty()) return sweep_usage_error("--csv: " + problem);
  TestProgress progress(a.quiet);
  TestOptions options{.seed = a.seed,
                      .seeds = static_cast<std::uint64_t>(a.seeds),
                      .jobs = static_cast<std::size_t>(a.jobs),
                      .stop_fd = interruption.fd()};
  options.on_progress = [&](const io::JobProgress& p, std::size_t failed) { progress.show(p, failed); };
  const Sweep sweep = run_sweep(std::move(spec), options);
  progress.end();

  const bool on_stdout = a.json == "-" || a.csv == "-";
  if (!a.quiet || !on_stdout) io::print(on_stdout ? stderr : stdout, sweep_map(sweep));
  const bool interrupted = sweep.runs.not_run() > 0 && interruption.signalled();
  if (interrupted)
    SignalWatcher::report("sweep", std::to_string(sweep.runs.all() - sweep.runs.not_run()) + " of " +
                                       std::to_string(sweep.runs.all()) + " runs");
  json_file.write(sweep_json(sweep));
  csv_file.write(sweep_csv(sweep));
  return exit_status("tandem-netsim sweep", {json_file.close(), csv_file.close()}, !interrupted && sweep.good());
}

}  // namespace

void add_sweep_command(const io::Command& root) {
  const auto [command, a] = root.add_command(
      "sweep", "Runs a scene over a grid of networks and maps one number, or compares laws over a file of cells.",
      sweep_command);
  command.add_option("scene", a.scene, "a scene file, or the name of a shipped scene (tandem-server scenes)")
      .value_name(" ");
  command.add_option("--delay", a.delay, "constant delays, each direction [ms], 0 to 60000").value_name("MS,MS,...");
  command
      .add_option("--jitter", a.jitter,
                  "delays uniform in [0, MS] added to every datagram [ms], 0 to 60000; order is kept")
      .value_name("MS,MS,...");
  command.add_option("--loss", a.loss, "datagrams lost, each alone [%], 0 to 100").value_name("PERCENT,...");
  command
      .add_option("--metric", a.metric,
                  "the number of the map, as in `run --json`: tracking_rms_m (default), force_error_rms_n, "
                  "effort_peak_n, gate_trips, "
                  "held_s, ...; the worst seat or tool over all seeds counts")
      .value_name("NAME");
  command.add_option("--seeds", a.seeds, "how many seeds of each point; default 1")
      .check(io::whole_number_in(1, 10'000))
      .value_name("N");
  command.add_option("--seed", a.seed, "the first seed; default 1").check(io::whole_number()).value_name("FIRST");
  command.add_option("--jobs", a.jobs, "runs at a time; default: one per core. No result depends on it")
      .check(io::whole_number_in(1, 256))
      .value_name("N");
  command.add_option("--duration", a.duration_s, "session time instead of the scene's")
      .check(io::number_in(0.1, 3e6, "s"))
      .value_name("S");
  command.add_option("--channel", a.channel, law_help()).check(io::one_of(law_names()));
  command.add_option("--coupling", a.coupling, coupling_help()).check(io::one_of(coupling_names()));
  command.add_option("--mfs", a.mfs, "flow sources instead of the scene's: open, tank, seed, seed_signed")
      .check(io::one_of({"open", "tank", "seed", "seed_signed"}));
  command
      .add_option(
          "--cells", a.cells,
          "instead of a scene: a file of cells, or the name of a shipped one (--list): laws, couplings, networks "
          "and tasks")
      .value_name("FILE");
  command.add_flag("--list", a.list, "lists the shipped files of cells");
  command.add_option("--cell", a.cell, "with --cells: this cell only, and all its numbers")
      .check(io::whole_number_in(1, 20'000))
      .value_name("N");
  command
      .add_option("--resume", a.resume,
                  "with --cells: keeps every finished cell in this file, and continues from it. Results of another "
                  "program or of other cells are rejected")
      .value_name("FILE");
  command.add_option("--html", a.html, "with --cells: writes tables and heat maps as one page; `-`: to standard output")
      .value_name("FILE|-");
  command
      .add_option("--figure", a.figure,
                  "with --cells: writes tracking and stiffness over the delay as SVG; `-`: to standard output")
      .value_name("FILE|-");
  command.add_option("--json", a.json, "writes all points and seeds; `-`: to standard output").value_name("FILE|-");
  command.add_option("--csv", a.csv, "writes one row per point; `-`: to standard output").value_name("FILE|-");
  command.add_flag("--quiet", a.quiet, "no progress, and no map beside --json - or --csv -");
  command.footer(
      "Exit: 0 no promised invariant was broken anywhere, 1 one was, a run could not begin, or it was interrupted, 2 "
      "wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim sweep free_motion --delay 0,20,50,100 --loss 0,5,20\n"
      "  tandem-netsim sweep contact --delay 0,10,20,40 --jitter 0,5 --metric force_error_rms_n --seeds 5 --csv "
      "map.csv\n"
      "  tandem-netsim sweep contact --delay 0,50,100,200 --channel raw\n"
      "  tandem-netsim sweep --cells comparison --resume comparison.cells --csv comparison.csv --html comparison.html\n"
      "  tandem-netsim sweep --cells comparison --cell 17");
}

}  // namespace tandem::netsim
