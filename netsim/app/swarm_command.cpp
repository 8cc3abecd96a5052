#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/heap_count.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/parallel_jobs.h"
#include "common/io/print.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/quality/quality_json.h"
#include "netsim/system/session_notes.h"
#include "netsim/system/swarm.h"
#include "server/report/trace_csv.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

/// Failures that are listed; the rest is counted.
constexpr std::size_t kShown = 20;

struct SwarmArguments {
  std::uint64_t first = 1, seeds = 500;
  double fault_phase_max_s = 40;
  std::size_t jobs = 0;
  bool fail_fast = false, scene = false;
  std::string law = "replica", json, trace;
};

LawKind law_of(const SwarmArguments& arguments) {
  return arguments.law == "replica" ? LawKind::kReplica : LawKind::kSetPosition;
}

std::string replay_command(const SwarmArguments& arguments, std::uint64_t seed) {
  std::string text = format("tandem-netsim swarm --first %llu --seeds 1", static_cast<unsigned long long>(seed));
  if (arguments.fault_phase_max_s != SwarmArguments{}.fault_phase_max_s)
    text += format(" --fault-phase %g", arguments.fault_phase_max_s);
  if (arguments.law != SwarmArguments{}.law) text += " --law set_position";
  return text + " --trace trace.csv";
}

Json to_json(const SwarmCase& which, const SwarmResult& result, double cpu_s) {
  Json json;
  json["seed"] = which.seed;
  json["what"] = which.description;
  json["passed"] = result.passed();
  json["masters"] = which.setup.scene.masters();
  json["seats"] = which.setup.scene.seats.size();
  json["tools"] = which.setup.scene.tools.size();
  json["lived_s"] = result.lived_s;
  json["recovered_s"] = result.recovered_s;
  json["gate_trips"] = result.gate_trips;
  json["fingerprint"] = format("%016llx", static_cast<unsigned long long>(result.fingerprint));
  json["trouble"] = result.trouble;
  json["violations"] = Json::array();
  for (const server::Violation& v : result.violations)
    json["violations"].push_back({{"invariant", v.invariant}, {"seat", v.seat}, {"at_s", v.at_s}, {"count", v.count}});
  if (which.setup.monitor_quality) {
    json["network_words"] = quality_report(result.links, false);
    for (const NamedLink& one : result.links) json["quality"][one.name] = quality_json(one.link);
  }
  json["cpu_s"] = cpu_s;
  return json;
}

/// Runs one seed in the process of its job.
std::string live_seed(const SwarmArguments& arguments, std::uint64_t seed, io::JobProgressReporter share) {
  const std::clock_t begin = std::clock();
  SwarmCase which = generate_swarm_case(seed, arguments.fault_phase_max_s, law_of(arguments));
  which.setup.keep_record = !arguments.trace.empty();
  which.setup.monitor_quality = arguments.seeds == 1;
  which.setup.heap_count = heap_allocations;
  const double whole = seconds(which.recovery_start) + 1;
  io::OutputFile trace;
  if (const auto problem = trace.open(arguments.trace, false); !problem.empty())
    throw std::runtime_error("--trace: " + problem);
  const server::TraceCsv csv{which.setup.scene};
  std::string rows = csv.header();
  const SwarmResult result = run_swarm_case(which, [&](Simulation& simulation) {
    share.set(seconds(simulation.now() - Time{}) / whole);
    if (!trace.is_open()) return;
    csv.append(simulation.record(), rows);
    if (rows.size() < 60'000) return;
    trace.write(rows);
    rows.clear();
  });
  trace.write(rows);
  if (const auto problem = trace.close(); !problem.empty()) throw std::runtime_error("--trace: " + problem);
  return to_json(which, result, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC).dump();
}

/// Sums over all seeds.
struct SwarmSum {
  std::size_t done = 0, failed = 0, not_run = 0;
  double lived_s = 0, cpu_s = 0, recovered_max_s = 0, small_lived_s = 0, small_cpu_s = 0;
  std::uint64_t gate_trips = 0;
  std::map<std::string, std::size_t> by_reason;
  Json seeds = Json::array();
  std::vector<std::string> failures;
  std::string network;  ///< description; only for a single session

  void add(const SwarmArguments& arguments, std::uint64_t seed, const io::JobResult& result) {
    if (result.state == io::JobResult::State::kNotRun) {
      ++not_run;
      return;
    }
    ++done;
    Json json;
    if (result.state == io::JobResult::State::kCrashed) {
      json = {{"seed", seed}, {"passed", false}, {"trouble", result.reason}, {"violations", Json::array()}};
    } else {
      json = Json::parse(result.text);
      lived_s += json["lived_s"].get<double>();
      cpu_s += json["cpu_s"].get<double>();
      recovered_max_s = std::max(recovered_max_s, json["recovered_s"].get<double>());
      gate_trips += json["gate_trips"].get<std::uint64_t>();
      if (json.contains("network_words")) network = json["network_words"].get<std::string>();
      json.erase("network_words");
      if (json["masters"] == 2 && json["seats"] == 2 && json["tools"] == 1) {
        small_lived_s += json["lived_s"].get<double>();
        small_cpu_s += json["cpu_s"].get<double>();
      }
    }
    if (!json["passed"].get<bool>()) {
      ++failed;
      describe(arguments, seed, json);
    }
    seeds.push_back(std::move(json));
  }

  void describe(const SwarmArguments& arguments, std::uint64_t seed, const Json& json) {
    std::string text = format("seed %llu", static_cast<unsigned long long>(seed));
    if (json.contains("what")) text += " (" + json["what"].get<std::string>() + ")";
    text += "\n";
    for (const Json& v : json["violations"]) {
      ++by_reason[v["invariant"].get<std::string>()];
      text += "  " + v["invariant"].get<std::string>() + " broken" +
              (v["seat"] == "" ? "" : " at " + v["seat"].get<std::string>()) +
              format(", first at %.3f s of session time, %llu times\n", v["at_s"].get<double>(),
                     static_cast<unsigned long long>(v["count"].get<std::uint64_t>()));
    }
    if (json["trouble"] != "") {
      ++by_reason["liveness"];
      text += "  " + json["trouble"].get<std::string>() + "\n";
    }
    failures.push_back(text + "  again: " + replay_command(arguments, seed) + "\n");
  }
};

std::string summary(const SwarmArguments& arguments, const SwarmSum& sum, double wall_s) {
  std::string text;
  for (std::size_t i = 0; i < sum.failures.size() && i < kShown; ++i) text += sum.failures[i];
  if (sum.failures.size() > kShown) text += format("and %zu more that failed\n", sum.failures.size() - kShown);
  for (const auto& [reason, count] : sum.by_reason) text += format("%-22s broken %zu times\n", reason.c_str(), count);
  text += format("%zu of %llu sessions passed, %zu failed%s\n", sum.done - sum.failed,
                 static_cast<unsigned long long>(arguments.seeds), sum.failed,
                 sum.not_run > 0 ? format(", %zu not run", sum.not_run).c_str() : "");
  text += format("%.0f session-seconds in %.1f s, %.0f CPU-seconds: %.0f x real time per core over all sizes",
                 sum.lived_s, wall_s, sum.cpu_s, sum.cpu_s > 0 ? sum.lived_s / sum.cpu_s : 0.0);
  if (sum.small_cpu_s > 0) text += format(", %.0f x with two masters and a slave", sum.small_lived_s / sum.small_cpu_s);
  text += format("\n%llu gate trips; recovery phase: every seat was active again within %.1f s (limit %g s)\n",
                 static_cast<unsigned long long>(sum.gate_trips), sum.recovered_max_s, kRecoveryLimit);
  return text + sum.network;
}

int print_scene(const SwarmArguments& arguments) {
  const SwarmCase which = generate_swarm_case(arguments.first, arguments.fault_phase_max_s, law_of(arguments));
  std::printf("# seed %llu: %s\n%s", static_cast<unsigned long long>(which.seed), which.description.c_str(),
              which.scene_text.c_str());
  for (const Fault& f : which.setup.faults)
    std::printf("# fault at %.3f s for %.3f s: %s%s%s\n", seconds(f.at), seconds(f.length),
                std::string(name(f.kind)).c_str(), f.seat.empty() ? "" : " at ", f.seat.c_str());
  std::fputs(network_listing(which.setup, "# ").c_str(), stdout);
  return 0;
}

int swarm_command(const SwarmArguments& arguments) {
  io::UsageErrors mistakes;
  if (!arguments.trace.empty() && arguments.seeds != 1) mistakes.add("--trace is of one session; add --seeds 1");
  for (const auto& [option, file] : {std::pair{"--json", arguments.json}, std::pair{"--trace", arguments.trace}})
    mistakes.output_file(option, file);
  if (arguments.trace == "-") mistakes.add("--trace: standard output is for --json; name a file");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim swarm");
  if (arguments.scene) return print_scene(arguments);

  const SignalWatcher interruption;
  io::StatusLine line{false};
  double wall_s = 0, shown_s = -1e9;
  io::JobOptions options;
  options.jobs = arguments.jobs;
  options.stop_fd = interruption.fd();
  options.watch = [&](const io::JobProgress& p) {
    wall_s = p.elapsed_s;
    if (wall_s - shown_s < 1e-3 * line.interval_ms()) return;
    shown_s = wall_s;
    line.show(format("%zu of %zu sessions, %.0f s%s", p.done, p.count, p.elapsed_s,
                     std::isnan(p.left_s) ? "" : format(", about %.0f s left", p.left_s).c_str()));
  };
  options.keep_going = [&](std::size_t, const io::JobResult& result) {
    return !arguments.fail_fast ||
           (result.state == io::JobResult::State::kDone && Json::parse(result.text)["passed"].get<bool>());
  };
  const auto results = io::run_jobs(
      arguments.seeds,
      [&](std::size_t i, io::JobProgressReporter share) { return live_seed(arguments, arguments.first + i, share); },
      options);
  line.clear();

  SwarmSum sum;
  for (std::size_t i = 0; i < results.size(); ++i) sum.add(arguments, arguments.first + i, results[i]);
  const bool json_on_stdout = arguments.json == "-";
  io::print(json_on_stdout ? stderr : stdout, summary(arguments, sum, wall_s));
  const bool interrupted = sum.not_run > 0 && interruption.signalled();
  if (interrupted)
    SignalWatcher::report("swarm",
                          format("%zu of %llu sessions", sum.done, static_cast<unsigned long long>(arguments.seeds)));
  io::OutputFile json;
  std::string problem = json.open(arguments.json, true);
  if (json.is_open()) {
    Json out;
    out["program"] = "tandem-netsim swarm";
    out["passed"] = sum.failed == 0 && sum.not_run == 0;
    out["interrupted"] = interrupted;
    out["lived_s"] = sum.lived_s;
    out["failed"] = sum.failed;
    out["not_run"] = sum.not_run;
    out["seeds"] = std::move(sum.seeds);
    json.write(out.dump(1) + "\n");
  }
  if (problem.empty()) problem = json.close();
  if (!problem.empty()) {
    io::print_formatted(stderr, "tandem-netsim swarm: --json: %s\n", problem.c_str());
    return io::kExitTrouble;
  }
  return !interrupted && sum.failed == 0 && sum.not_run == 0 ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_swarm_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("swarm",
                       "Runs random sessions: seats, tools, hands, networks and faults from "
                       "one seed each, every invariant checked in every tick.",
                       swarm_command);
  command.add_option("--first", arguments.first, "first seed; default 1").check(io::whole_number()).value_name("N");
  command.add_option("--seeds", arguments.seeds, "how many sessions; default 500")
      .check(io::whole_number_in(1, 10'000'000))
      .value_name("N");
  command
      .add_option("--law", arguments.law,
                  "law of the hands: replica (default) or set_position; all else is drawn alike")
      .check(io::one_of({"replica", "set_position"}))
      .value_name("LAW");
  command
      .add_option("--fault-phase", arguments.fault_phase_max_s,
                  "longest fault phase [s], in which networks, clients and devices fail; default 40")
      .check(io::number_in(2, 3600, "s"))
      .value_name("S");
  command.add_option("--jobs", arguments.jobs, "sessions at a time; default one per core")
      .check(io::whole_number_in(1, 1024))
      .value_name("N");
  command.add_flag("--fail-fast", arguments.fail_fast, "stops at the first session that fails");
  command.add_flag("--scene", arguments.scene, "only prints the scene, faults, clocks and network of the first seed");
  command.add_option("--json", arguments.json, "writes every session's result; `-`: to standard output")
      .value_name("FILE|-");
  command.add_option("--trace", arguments.trace, "with --seeds 1: writes one row per tick").value_name("FILE.csv");
  command.footer(
      "A session has a fault phase, with every fault drawn for it, and a recovery phase: the network is good, nothing "
      "fails,\n"
      "and simulated users reset every latched gate. Every seat must be active again within 10 s of its begin, or of "
      "the\n"
      "arrival of the last datagram from before. The same seed and --fault-phase give the same session with the same "
      "build.\n\n"
      "Examples\n"
      "  tandem-netsim swarm --seeds 500\n"
      "  tandem-netsim swarm --first 17 --seeds 1 --trace trace.csv\n"
      "  tandem-netsim swarm --first 17 --scene\n\n"
      "Exit: 0 all passed, 1 something failed or was interrupted, 2 wrong arguments or files.");
}

}  // namespace tandem::netsim
