#include <cstdio>
#include <filesystem>
#include <utility>

#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "common/setup/device_stiffness.h"
#include "proto/io/scene_file.h"
#include "proto/text/scene_text.h"
#include "server/app/commands/run_scores.h"
#include "server/app/commands/server_commands.h"
#include "server/app/control/server_keys.h"
#include "server/app/process/server_process.h"

namespace tandem::server {
namespace {

/// Arguments as given. Numbers stay text until `parse_options`, so that all errors are reported together.
struct RunArguments {
  std::string scene, listen = "127.0.0.1:0", state, duration, wait, seed = "1", json, trace, record, metrics,
                     log = "text";
  bool check = false, quiet = false, fresh = false, pseudonyms = false, on_order = false, scores = false;
};

/// A recording never replaces a file, and a user who names one expects it there.
std::string record_problem(const std::string& target) {
  std::error_code error;
  if (std::filesystem::is_regular_file(target, error)) return "exists already; choose another name";
  return recording_target_problem(target);
}

/// Converts the arguments; adds all errors.
ServerOptions parse_options(const RunArguments& arguments, io::UsageErrors& errors) {
  ServerOptions plan{.control = {.state = arguments.state}, .quiet = arguments.quiet, .no_restore = arguments.fresh};
  SessionOptions& session =
      plan.sessions.emplace_back(SessionOptions{.json = arguments.json, .trace = arguments.trace});
  if (auto scene = load_scene(arguments.scene)) {
    session.scene = std::move(*scene);
    session.name = session.scene.name;
  } else {
    errors.add(to_text(scene.error()));
  }
  if (const auto listen = io::parse_address(arguments.listen, 0)) {
    plan.control.listen = *listen;
    if (const auto keys = open_server_keys(*listen, arguments.state); !keys)
      errors.add("--listen " + arguments.listen, keys.error());
  } else {
    errors.add("--listen", listen.error());
  }
  if (!arguments.metrics.empty()) {
    if (const auto metrics = io::parse_address(arguments.metrics, 0)) {
      plan.control.metrics = *metrics;
    } else {
      errors.add("--metrics", metrics.error());
    }
  }
  if (arguments.log == "json") {
    plan.json_log = io::Level::kInfo;
  } else if (arguments.log != "text") {
    errors.add("--log", "\"" + arguments.log + "\" must be text or json");
  }
  if (const double s = errors.optional_number("--duration", arguments.duration, 0.1, 3e6, "s"); s > 0)
    session.scene_duration = std::exchange(session.scene.duration, s);
  plan.start_timeout_s = errors.optional_number("--start-timeout", arguments.wait, 0.1, 3e6, "s");
  std::string seed = arguments.seed;
  const std::string problem = io::whole_number()(seed);
  errors.add("--seed", problem);
  if (problem.empty()) session.seed = std::stoull(seed);
  errors.output_file("--json", session.json);
  if (!session.trace.empty()) errors.add("--trace", io::OutputFile::problem(session.trace));
  session.record = {
      .target = arguments.record, .pseudonyms = arguments.pseudonyms, .from_start = !arguments.on_order, .limits = {}};
  if (!arguments.record.empty()) errors.add("--record " + arguments.record, record_problem(arguments.record));
  if (arguments.record.empty() && (arguments.pseudonyms || arguments.on_order))
    errors.add(arguments.pseudonyms ? "--pseudonyms" : "--record-on-order", "needs --record");
  if (arguments.scores && !arguments.record.ends_with(".mcap"))
    errors.add("--scores", "needs --record FILE.mcap, from which they are computed; a folder gets names of its own");
  if (arguments.scores && arguments.json == "-") errors.add("--scores", "excludes --json -; name a file");
  plan.record = session.record;
  if (!session.trace.empty() && session.trace == session.json) errors.add("--trace", "is the same file as --json");
  return plan;
}

int run_command(const RunArguments& arguments) {
  io::UsageErrors errors;
  const ServerOptions plan = parse_options(arguments, errors);
  if (!errors.empty()) return errors.report("tandem-server run");
  if (plan.control.metrics && !plan.control.metrics->loopback())
    io::print_formatted(stderr, "--metrics %s: %s\n", arguments.metrics.c_str(), kUnprotectedMetricsWarning);
  if (!arguments.check) {
    const int code = run_server(plan);
    const std::string problem =
        arguments.scores ? add_scores(arguments.record, arguments.json, arguments.quiet) : std::string();
    if (problem.empty()) return code;
    io::print(stderr, "tandem-server run: " + problem + "\n");
    return io::kExitTrouble;
  }
  const SceneSpec& scene = plan.sessions.front().scene;
  std::printf("%s%s", effective_scene_text(scene).c_str(), setup::granted_listing(scene).c_str());
  std::puts(
      "# A real device gets at most the stiffness that it renders. Its client and the server's log report a spring "
      "that\n"
      "# is more than a tenth softer than the scene's.\n");
  std::printf("# OK: %s has no mistake; nothing was started\n", arguments.scene.c_str());
  return 0;
}

}  // namespace

void add_run_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("run", "Hosts a session: waits for the scene's seats, runs it, reports.", run_command);
  command.add_option("SCENE", arguments.scene, "a scene file, or the name of a shipped scene (tandem-server scenes)")
      .value_name(" ")
      .required();
  command
      .add_option("--listen", arguments.listen,
                  "address at which clients join, UDP and TCP; port 0 takes a free one; default 127.0.0.1:0. Any "
                  "other address than "
                  "loopback needs `tandem-server init` and an enrolled workstation")
      .value_name("HOST:PORT");
  command
      .add_option("--state", arguments.state,
                  "folder of keys and enrolled workstations; default on loopback: ephemeral keys, for this user on "
                  "this computer; "
                  "else $TANDEM_STATE, /var/lib/tandem where this user may write, ~/.local/state/tandem")
      .value_name("DIR");
  command.add_option("--duration", arguments.duration, "session time instead of the scene's [s]").value_name("S");
  command
      .add_option("--start-timeout", arguments.wait,
                  "ends when the required seats are not ready after so many seconds; default: waits until Ctrl-C")
      .value_name("S");
  command
      .add_option("--json", arguments.json,
                  "writes the report; `-`: to standard output, and everything else to standard error")
      .value_name("FILE|-");
  command.add_option("--trace", arguments.trace, "writes one row per tick of the session").value_name("FILE.csv");
  command
      .add_option("--record", arguments.record,
                  "records the session: an MCAP file for Foxglove, Rerun, PlotJuggler and tandem-netsim. A folder gets "
                  "one with a name of its own. All participants see that a recording runs")
      .value_name("FILE.mcap|DIR");
  command.add_flag("--pseudonyms", arguments.pseudonyms,
                   "the recording has P1, P2 ... instead of names of participants and workstations");
  command.add_flag("--record-on-order", arguments.on_order,
                   "records only from `tandem-client control record start` on, or the button of the console");
  command.add_flag("--scores", arguments.scores,
                   "the report has the main scores of the recording (--record FILE.mcap), with flags, as "
                   "tandem-netsim score; reads the recording at the end");
  command
      .add_option("--metrics", arguments.metrics,
                  "serves /metrics (Prometheus), /healthz and /readyz at this address over HTTP; default: off")
      .value_name("HOST:PORT");
  command.add_option("--log", arguments.log, "text, or json: one object per line on standard error; default text")
      .value_name("FORMAT");
  command.add_flag("--check", arguments.check, "only checks everything and prints every value in force, with units");
  command
      .add_option("--seed", arguments.seed,
                  "a number for the report, to name the run; default 1 (a live session draws nothing)")
      .value_name("N");
  command.add_flag(
      "--no-restore", arguments.fresh,
      "ignores the checkpoint of a server of this scene that ended here less than 10 min ago; default: restores the "
      "session, "
      "and its clients reconnect automatically (not with port 0 on loopback, where no client would find it)");
  command.add_flag("--quiet", arguments.quiet, "no status and no summary");
  command.footer(
      "Prints `listening on HOST:PORT` first, then the command of each seat to type. The session begins when all "
      "required\n"
      "seats are ready. Ctrl-C releases all hands, notifies the clients, writes the reports and ends with 0.\n"
      "Exit: 0 done and verdict pass; 1 verdict fail, port in use, required seats missing, peers lost; 2 wrong "
      "arguments or "
      "files.\n\n"
      "Examples\n"
      "  tandem-server run free_motion\n"
      "  tandem-server run contact --listen 127.0.0.1:7000 --json report.json --trace contact.csv\n"
      "  tandem-server run lesson --record lesson.mcap --pseudonyms\n"
      "  tandem-server run mine.textproto --check");
}

}  // namespace tandem::server
