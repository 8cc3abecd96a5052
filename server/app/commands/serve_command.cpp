#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include "common/auth/enrolment.h"
#include "common/io/command_line.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "proto/io/scene_file.h"
#include "proto/text/server_config_text.h"
#include "server/app/commands/server_commands.h"
#include "server/app/control/server_keys.h"
#include "server/app/process/server_process.h"
#include "server/app/service/service_config.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

struct ServeArguments {
  std::string config;
  bool check = false, quiet = false;
};

/// Path that the configuration names, relative to the configuration's directory.
std::string path_beside_config(const ServerConfigSpec& config, const std::string& named) {
  if (named.empty() || fs::path(named).is_absolute()) return named;
  const fs::path folder = fs::path(config.file).parent_path();
  return folder.empty() ? named : (folder / named).string();
}

/// A bare name is a shipped scene, unless a file of this name is beside the configuration.
std::string scene_file(const ServerConfigSpec& config, const std::string& named) {
  const bool bare = named.find_first_of("/.") == std::string::npos;
  const std::string file = path_beside_config(config, named);
  std::error_code error;
  return bare && !fs::is_regular_file(file, error) ? named : file;
}

std::string folder_error(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return "is not a folder; create it first";
  return ::access(path.c_str(), W_OK | X_OK) == 0 ? "" : "is not writable for this user";
}

RecordingOptions recording_options_from(const ServerConfigSpec& config, const LocatedText& record) {
  const RecordingSpec& in = config.recording;
  constexpr double kMib = 1 << 20;
  return {.target = path_beside_config(config, record.text),
          .pseudonyms = in.pseudonyms,
          .from_start = in.from_start,
          .limits = {.file_bytes = static_cast<std::uint64_t>(in.file_mib * kMib),
                     .file_s = 60 * in.file_minutes,
                     .total_bytes = static_cast<std::uint64_t>(in.total_mib * kMib),
                     .bytes_per_s = in.mib_per_min * kMib / 60},
          .inputs_bytes = static_cast<std::uint64_t>(in.inputs_mib * kMib)};
}

SessionOptions session_options_from(const ServerConfigSpec& config, const ConfiguredSessionSpec& in,
                                    InputErrors& errors) {
  SessionOptions out{.name = in.name,
                     .reports = path_beside_config(config, config.reports.text),
                     .tickets_only = in.tickets_only,
                     .restart = in.restart};
  if (in.scene.text.empty()) return out;  // reported already
  if (auto scene = load_scene(scene_file(config, in.scene.text))) {
    out.scene = std::move(*scene);
  } else {
    // Errors of the scene file, each with the place in the configuration that names it.
    for (const InputError& error : scene.error()) errors.push_back(in.scene.error(config.file, to_text(error)));
  }
  if (auth::canonical_session_code(in.name))
    errors.push_back(in.placed_name.error(config.file,
                                          "has the form of a session code (10 letters and digits), so no client could "
                                          "join by this name; choose a shorter one"));
  if (in.duration_s > 0) out.scene_duration = std::exchange(out.scene.duration, in.duration_s);
  const LocatedText& record = in.record.text.empty() ? config.record : in.record;
  out.record = recording_options_from(config, record);
  if (!in.record.text.empty())
    if (const std::string problem = recording_target_problem(out.record.target); !problem.empty())
      errors.push_back(in.record.error(config.file, problem));
  return out;
}

ServerOptions parse_options(const ServerConfigSpec& config, InputErrors& errors) {
  const ConnectionLimitsSpec& limits = config.limits;
  ServerOptions plan{
      .command = "serve",
      .control = {.state = path_beside_config(config, config.state.text),
                  .load_limits = {limits.core_percent / 100},
                  .metrics_hosts = config.metrics_hosts,
                  .audit = {static_cast<std::uint64_t>(config.audit.file_mib * (1 << 20)), config.audit.older_files}},
      .threads = limits.threads,
      .created_max = limits.created_sessions,
      .scenes = path_beside_config(config, config.scenes.text),
      .reports = path_beside_config(config, config.reports.text),
      .record = recording_options_from(config, config.record),
      .sessions_resume = true};
  ControlOptions& control = plan.control;
  control.notes = plan.reports;
  if (const auto listen = io::parse_address(config.listen.text, 0)) {
    control.listen = *listen;
    if (const std::string problem = problem_with_address(*listen); !problem.empty())
      errors.push_back(config.listen.error(config.file, problem));
    const LocatedText& keys = config.state.text.empty() ? config.listen : config.state;
    for (const std::string& problem : problems_with_keys(*listen, control.state))
      errors.push_back(keys.error(config.file, problem));
  } else if (!config.listen.text.empty()) {
    errors.push_back(config.listen.error(config.file, listen.error()));
  }
  if (!config.metrics.text.empty()) {
    if (const auto metrics = io::parse_address(config.metrics.text, 0)) {
      control.metrics = *metrics;
      if (const std::string problem = problem_with_address(*metrics); !problem.empty())
        errors.push_back(config.metrics.error(config.file, problem));
      const bool same_host =
          control.listen.any() || metrics->any() || io::to_text(*metrics) == io::to_text(control.listen);
      if (metrics->port() != 0 && metrics->port() == control.listen.port() && same_host)
        errors.push_back(config.metrics.error(config.file, "is the address of `listen`, too; give it another port"));
    } else {
      errors.push_back(config.metrics.error(config.file, metrics.error()));
    }
  }
  if (!config.reports.text.empty())
    if (const std::string problem = folder_error(path_beside_config(config, config.reports.text)); !problem.empty())
      errors.push_back(config.reports.error(config.file, problem));
  if (!config.record.text.empty())
    if (const std::string problem = folder_error(path_beside_config(config, config.record.text)); !problem.empty())
      errors.push_back(config.record.error(config.file, problem));
  std::error_code error;
  if (!plan.scenes.empty() && !fs::is_directory(plan.scenes, error))
    errors.push_back(config.scenes.error(config.file, "is not a folder"));
  plan.directory = service_options_from(
      config, config.listen.text.empty() ? std::nullopt : std::optional(control.listen),
      [&config](const std::string& named) { return path_beside_config(config, named); }, errors);
  plan.service = plan.directory.has_value();
  if (plan.directory && errors.empty()) {
    // The keys are known to be readable.
    const auto keys = open_server_keys(control.listen, control.state);
    if (const std::string problem = keys ? membership_error(*plan.directory, *keys) : keys.error(); !problem.empty())
      errors.push_back(config.directory->whole.error(config.file, problem));
  }
  plan.version = TANDEM_VERSION;
  for (const ConfiguredSessionSpec& session : config.sessions)
    plan.sessions.push_back(session_options_from(config, session, errors));
  control.limits.accept = {limits.accepts_per_s, limits.accepts_burst, limits.accepts_per_s_all,
                           limits.accepts_per_s_all};
  control.limits.pending = limits.pending;
  control.limits.connections = limits.connections;
  control.limits.deadline = std::chrono::milliseconds(static_cast<std::int64_t>(limits.deadline_s * 1000));
  if (config.log.json) plan.json_log = static_cast<io::Level>(config.log.level);
  return plan;
}

int refuse(const InputErrors& errors) {
  io::UsageErrors usage;
  usage.add(to_text(errors));
  return usage.report("tandem-server serve");
}

int serve_command(const ServeArguments& arguments) {
  const auto text = read_text_file(arguments.config);
  if (!text) return refuse(text.error());
  InputErrors errors, more;
  const auto config = read_server_config(*text, arguments.config, errors);
  if (!config) return refuse(errors);
  // Continues after errors, so that all of them are reported at once.
  ServerOptions plan = parse_options(*config, more);
  errors.insert(errors.end(), more.begin(), more.end());
  if (!errors.empty()) return refuse(errors);
  plan.quiet = arguments.quiet;
  if (plan.control.metrics && !plan.control.metrics->loopback())
    io::print_formatted(stderr, "%s\n",
                        to_text(config->metrics.error(config->file, kUnprotectedMetricsWarning)).c_str());
  if (!arguments.check) return run_server(plan);
  std::printf("%s# OK: %s has no mistake; nothing was started\n", effective_server_config_text(*config).c_str(),
              arguments.config.c_str());
  return 0;
}

}  // namespace

void add_serve_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "serve", "Hosts all sessions of a configuration until a signal or a stop command.", serve_command);
  command
      .add_option("CONFIG", arguments.config,
                  "a file of proto/schema/server_config.proto; server/README.md has the table of its keys")
      .value_name(" ")
      .required();
  command.add_flag("--check", arguments.check,
                   "only checks everything, the state folder too, and prints every value in force, with units");
  command.add_flag("--quiet", arguments.quiet, "no status and no summaries");
  command.footer(
      "Prints `listening on HOST:PORT` first, then the commands for participants; on a terminal with each session's "
      "code, elsewhere\n"
      "`tandem-server sessions` shows the codes. A session that is over restarts with a new code, unless\n"
      "`restart: false`. SIGTERM or Ctrl-C: new joins are rejected, all hands are released, reports are written, and "
      "the server ends within 3 s; a second\n"
      "signal ends it at once. If the server restarts within 10 min, however it ended, every session resumes with the "
      "same code, and its\n"
      "clients reconnect to their seats automatically. Sessions of different tick rates have threads of their own, "
      "behind one port.\n"
      "Exit: 0 ended by a signal, or all sessions over and passed; 1 trouble while running or verdict fail; 2 wrong "
      "arguments or files.\n\n"
      "Examples\n"
      "  tandem-server serve /etc/tandem/server.textproto --check\n"
      "  tandem-server serve server.textproto --quiet\n\n"
      "The file has at least\n"
      "  version: 1\n"
      "  listen: \"0.0.0.0:7000\"\n"
      "  session { name: \"lab\" scene: \"free_motion\" }");
}

}  // namespace tandem::server
