#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <filesystem>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "common/setup/device_stiffness.h"
#include "hal/io/motion_file.h"
#include "hal/io/recording_motion.h"
#include "netsim/app/law_options.h"
#include "netsim/app/lesson_loader.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/run_json.h"
#include "netsim/app/run_log.h"
#include "netsim/app/run_recording.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/score/score_output.h"
#include "netsim/system/run_simulation.h"
#include "netsim/system/session_notes.h"
#include "netsim/system/simulation.h"
#include "proto/io/scene_file.h"
#include "proto/text/scene_text.h"
#include "server/report/report_summary.h"

namespace tandem::netsim {
namespace {

struct RunArguments {
  std::string scene, channel, coupling, mfs, json, trace, record, log, replay;
  std::vector<std::string> hands;
  double duration_s = 0;
  bool check = false, quiet = false, verbose = false, no_quality = false, scores = false;
  NetworkOptions network;
};

int run_usage_error(const std::string& mistake) { return io::report_usage_error("tandem-netsim run", mistake); }

/// Adds the parts that depend on the seats: scripts and recordings name them.
/// @param notes  receives facts about the script's networks for the report
void understand_network(const RunArguments& arguments, SimulationConfig& setup, std::vector<std::string>& notes,
                        io::UsageErrors& mistakes) {
  std::vector<std::string> seats;
  for (const SeatSpec& seat : setup.scene.seats) seats.push_back(seat.name);
  if (auto script = arguments.network.events(seats)) {
    setup.events = std::move(script->events);
    add_notes(notes, script->notes);
  } else {
    mistakes.add(script.error());
  }
  if (arguments.replay.empty()) return;
  for (const std::string& other : arguments.network.all_given())
    mistakes.add("--replay excludes " + other + ": the log sets the verdict of every datagram");
  const auto replay = load_replay(arguments.replay);
  if (!replay) {
    mistakes.add("--replay: " + replay.error());
    return;
  }
  setup.replay = *replay;
  for (std::size_t i = 0; i < seats.size(); ++i)
    if (!setup.replay->has(static_cast<std::uint32_t>(i)))
      mistakes.add("--replay: " + arguments.replay + " holds no flow " + std::to_string(i) + ", which is seat " +
                   seats[i]);
}

/// Returns how many datagrams of a replay had a recorded decision of their own, for reports.
std::string replay_summary(const Simulation& simulation) {
  std::uint64_t sent = 0, own = 0;
  for (std::uint32_t link = 0; link < simulation.network().links(); ++link)
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      sent += simulation.network().counters(link, direction).in;
      own += simulation.network().replayed(link, direction);
    }
  return "replay: " + std::to_string(own) + " of " + std::to_string(sent) +
         " datagrams got their own recorded verdict" +
         (own == sent ? "\n" : ", the others that of the last one recorded before them\n");
}

void check_outputs(const RunArguments& arguments, io::UsageErrors& mistakes) {
  for (const auto& [option, file] : {std::pair{"--json", arguments.json}, std::pair{"--trace", arguments.trace}})
    if (!file.empty() && !(file == "-" && file == arguments.json)) mistakes.add(option, io::OutputFile::problem(file));
  if (arguments.trace == "-") mistakes.add("--trace: standard output is for --json; name a file");
  if (!arguments.trace.empty() && arguments.trace == arguments.json)
    mistakes.add("--trace: is the same file as --json");
  if (!arguments.log.empty()) {
    mistakes.add("--log", io::OutputFile::problem(arguments.log));
    if (arguments.log == "-") mistakes.add("--log: standard output is for --json; name a file");
    if (arguments.log == arguments.json || arguments.log == arguments.trace)
      mistakes.add("--log: is the same file as another result");
    if (arguments.log == arguments.replay) mistakes.add("--log: would overwrite what --replay reads");
  }
  if (arguments.scores && arguments.record.empty())
    mistakes.add("--scores: needs --record FILE.mcap, from which they are computed");
  if (arguments.record.empty()) return;
  mistakes.add("--record", io::OutputFile::problem(arguments.record));
  if (std::error_code error; std::filesystem::is_regular_file(arguments.record, error))
    mistakes.add("--record " + arguments.record + ": exists already; choose another name");
  if (arguments.record == "-") mistakes.add("--record: standard output is for --json; name a file");
  for (const std::string& other : {arguments.json, arguments.trace, arguments.log, arguments.replay})
    if (arguments.record == other) mistakes.add("--record: is the same file as another result or input");
}

/// Reads the motion of a hand from a recording.
/// @param text  `FILE.mcap[,seat=NAME]`  @param seat  whose motion it is without that option
std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, std::string> recorded_hand(const std::string& text,
                                                                                          const SeatSpec& seat) {
  const std::size_t cut = text.find(',');
  const std::string file = text.substr(0, cut), option = cut == std::string::npos ? "" : text.substr(cut + 1);
  constexpr std::string_view kSeat = "seat=";
  if (!option.empty() && !option.starts_with(kSeat))
    return std::unexpected(option + ": a recording takes seat=NAME only");
  return hal::load_recording_motion(file, option.empty() ? seat.name : option.substr(kSeat.size()), seat.hand);
}

/// Makes the configuration from the arguments; collects all errors.
SimulationConfig understand(const RunArguments& arguments, std::vector<std::string>& notes, io::UsageErrors& mistakes) {
  SimulationConfig setup;
  if (auto scene = load_scene(arguments.scene)) {
    setup.scene = std::move(*scene);
  } else {
    mistakes.add(to_text(scene.error()));
    check_outputs(arguments, mistakes);
    return setup;  // without a scene the seats are unknown, and names in scripts or hands cannot be checked
  }
  if (arguments.duration_s > 0) setup.scene.duration = arguments.duration_s;
  if (setup.scene.endless())
    mistakes.add("--duration: " + endless_scene_error(arguments.scene, "give --duration S, such as --duration 60"));
  set_coupling(setup.scene, arguments.coupling);
  set_law(setup.scene, arguments.channel, arguments.mfs);
  mistakes.add(law_option(arguments.channel, arguments.coupling), law_conflict(setup.scene, arguments.scene));
  for (const std::string& text : arguments.hands) {
    const auto cut = text.find('=');
    const std::string seat = text.substr(0, cut);
    const auto known = std::ranges::find_if(
        setup.scene.seats, [&](const SeatSpec& s) { return s.name == seat && s.kind == SeatKind::kMaster; });
    if (cut == std::string::npos || known == setup.scene.seats.end()) {
      std::string problem =
          "--hand " + text + ": must be SEAT=FILE.csv[,...] or SEAT=FILE.mcap[,seat=NAME] with SEAT one of:";
      for (const SeatSpec& s : setup.scene.seats)
        if (s.kind == SeatKind::kMaster) problem += " " + s.name;
      mistakes.add(problem);
      continue;
    }
    if (const std::string file = text.substr(cut + 1, text.find(',', cut) - cut - 1); file.ends_with(".mcap")) {
      auto motion = recorded_hand(text.substr(cut + 1), *known);
      if (motion)
        setup.motions[seat] = std::move(*motion);
      else
        mistakes.add("--hand " + seat + ": " + motion.error());
      continue;
    }
    const auto options = hal::sim::parse_motion_options(text.substr(cut + 1));
    if (!options) {
      mistakes.add("--hand " + seat + ": " + options.error());
      continue;
    }
    if (auto motion = hal::load_motion(*options)) {
      if (!arguments.quiet) io::print_formatted(stderr, "%s: %s\n", seat.c_str(), (*motion)->describe().c_str());
      setup.motions[seat] = std::move(*motion);
    } else {
      mistakes.add(motion.error());
    }
  }
  check_outputs(arguments, mistakes);
  setup.seed = arguments.network.seed();
  understand_network(arguments, setup, notes, mistakes);
  return setup;
}

/// Shows the progress on a terminal, some times per virtual second.
void show_progress(const Simulation& simulation) {
  std::fprintf(stderr, "\r\x1b[K%5.1f / %.1f s", simulation.session().clock().time(), simulation.scene().duration);
  std::fflush(stderr);
}

/// Prints all effective values: the scene's, then the network's.
int check(const RunArguments& arguments, const SimulationConfig& setup, const NetworkChoice& network) {
  std::string text = effective_scene_text(setup.scene) + setup::granted_listing(setup.scene);
  if (setup.replay) {
    text += "network of every seat: replay of " + arguments.replay + "\n";
  } else {
    text += "network: " + network.description + format(", seed %llu\n", static_cast<unsigned long long>(setup.seed)) +
            network_listing(setup, "  ");
    for (const std::string& note : network.notes) text += "note: " + note + "\n";
    for (const std::string& note : late_notes(setup)) text += "note: " + note + "\n";
  }
  std::printf("%s# OK: %s has no mistake; nothing was started\n", text.c_str(), arguments.scene.c_str());
  return 0;
}

/// Scores of the recorded session, computed from the file as `tandem-netsim score` does. @return or why there are none
std::expected<score::LessonScores, std::string> scores_of(const std::string& recording) {
  const auto lesson = load_lesson({.name = recording}, "");
  if (!lesson) return std::unexpected("--scores: " + lesson.error());
  auto scores = score::score_lesson(*lesson);
  if (!scores) return std::unexpected("--scores: " + recording + ": " + scores.error());
  return scores;
}

int run_command(const RunArguments& arguments) {
  io::UsageErrors mistakes;
  auto network = arguments.network.resolve();
  if (!network) mistakes.add(network.error());
  std::vector<std::string> script_notes;
  SimulationConfig setup = understand(arguments, script_notes, mistakes);
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim run");
  add_notes(network->notes, script_notes);
  setup.network = network->link;
  setup.monitor_quality = !arguments.no_quality;
  if (arguments.check) return check(arguments, setup, *network);
  RunRecording recording{setup};
  if (!arguments.record.empty()) setup.journal = &recording.journal();
  auto made = Simulation::make(setup);
  if (!made) return run_usage_error(made.error());
  const bool json_on_stdout = arguments.json == "-";
  io::OutputFile json_file, trace_file;
  if (const auto problem = json_file.open(arguments.json, true); !problem.empty())
    return run_usage_error("--json: " + problem);
  if (const auto problem = trace_file.open(arguments.trace, false); !problem.empty())
    return run_usage_error("--trace: " + problem);
  Simulation& simulation = **made;
  RunLog log;
  if (const auto problem = log.open(arguments.log); !problem.empty()) return run_usage_error("--log: " + problem);
  log.attach(simulation.network());
  if (const auto problem = recording.open(arguments.record); !problem.empty())
    return run_usage_error("--record: " + problem);
  recording.attach(simulation);

  const SignalWatcher interruption;
  const bool progress = !arguments.quiet && isatty(STDERR_FILENO) != 0;
  const std::clock_t begin = std::clock();
  SimulationResult run = run_simulation(simulation, setup.seed,
                                        {.keep_running =
                                             [&](double) {
                                               if (progress) show_progress(simulation);
                                               return !interruption.signalled();
                                             },
                                         .trace = [&](std::string_view rows) { trace_file.write(rows); },
                                         .tick =
                                             [&](Simulation&) {
                                               log.on_tick(simulation.now());
                                               recording.on_tick(simulation);
                                             }});
  if (progress) std::fprintf(stderr, "\r\x1b[K");
  if (!run.trouble.empty()) {
    io::print_formatted(stderr, "tandem-netsim run: %s\n", run.trouble.c_str());
    return io::kExitTrouble;
  }

  server::RunReport& report = run.report;
  report.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  const bool interrupted = run.interrupted, broken = !report.passed;
  report.passed = report.passed && !interrupted;
  const std::vector<NamedLink>& links = run.links;
  std::vector<std::string> notes;
  if (!setup.replay) notes = network->notes;
  for (std::string& note : session_notes(setup, session_span(simulation))) notes.push_back(std::move(note));
  std::vector<std::string> problems{trace_file.close(), log.close(), recording.close()};
  std::string words, scores_json;
  if (arguments.scores && problems.back().empty()) {
    if (const auto scores = scores_of(arguments.record)) {
      words = score::main_scores_text(*scores);
      scores_json = score::main_scores_json(*scores);
    } else {
      problems.push_back(scores.error());
    }
  }
  for (const std::string& note : notes) words += "note: " + note + "\n";
  if (!arguments.quiet || !json_on_stdout)
    io::print_formatted(
        json_on_stdout ? stderr : stdout, "%s: %s, %.1f s over %s, seed %llu, %.0f x real time\n%s%s%s%s",
        report.scenario.c_str(), interrupted && !broken ? "interrupted" : report.verdict_text(), report.duration_s,
        setup.replay ? ("replay of " + arguments.replay).c_str() : network->description.c_str(),
        static_cast<unsigned long long>(report.seed), report.cpu_s > 0 ? report.duration_s / report.cpu_s : 0.0,
        server::report_summary(report, simulation.scene()).c_str(), quality_report(links, arguments.verbose).c_str(),
        setup.replay ? replay_summary(simulation).c_str() : "", words.c_str());
  if (interrupted)
    SignalWatcher::report("run", format("%.3f of %g s of the session", report.duration_s, setup.scene.duration));
  if (json_file.is_open()) json_file.write(run_json(report, links, notes, interrupted, scores_json));
  problems.push_back(json_file.close());
  for (const std::string& problem : problems)
    if (!problem.empty()) {
      io::print_formatted(stderr, "tandem-netsim run: %s\n", problem.c_str());
      return io::kExitTrouble;
    }
  return !interrupted && report.passed ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_run_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "run", "Runs a whole session in virtual time: the same server and client cores, seeded.", run_command);
  command.add_option("scene", arguments.scene, "a scene file, or the name of a shipped scene (tandem-server scenes)")
      .value_name(" ")
      .required();
  arguments.network.add_to(command);
  command
      .add_option(
          "--hand", arguments.hands,
          "a recorded motion moves this seat's hand: SEAT=FILE.csv[,columns=PREFIX][,rec=N][,scale=auto|S]"
          "[,axes=+x+y+z][,end=hold|loop], or a hand of a recording: SEAT=FILE.mcap[,seat=NAME]; may be repeated")
      .value_name("SEAT=FILE...")
      .one_value();
  command.add_option("--channel", arguments.channel, law_help()).check(io::one_of(law_names()));
  command.add_option("--coupling", arguments.coupling, coupling_help()).check(io::one_of(coupling_names()));
  command
      .add_option(
          "--mfs", arguments.mfs,
          "flow sources instead of the scene's: open (followers get what they need), tank (only what was dissipated), "
          "seed, seed_signed (two readings of the source paper's equation 3)")
      .check(io::one_of({"open", "tank", "seed", "seed_signed"}));
  command
      .add_option("--duration", arguments.duration_s,
                  "session time instead of the scene's; a scene without an end (no duration_s) needs it")
      .check(io::number_in(0.1, 3e6, "s"))
      .value_name("S");
  command.add_option("--json", arguments.json, "writes the report; `-`: to standard output").value_name("FILE|-");
  command.add_option("--trace", arguments.trace, "writes one row per tick; the same seed and build give the same bytes")
      .value_name("FILE.csv");
  command
      .add_option("--record", arguments.record,
                  "writes the recording of the session (MCAP); the same seed and build give the same bytes")
      .value_name("FILE.mcap");
  command.add_flag("--scores", arguments.scores,
                   "the report has the main scores of the recording (--record), with flags, as tandem-netsim score");
  command
      .add_option(
          "--log", arguments.log,
          "writes the verdict of every datagram and copy: t_in_ns,link,dir,flow,idx,size,verdict,t_out_ns,cause")
      .value_name("FILE.csv");
  command
      .add_option(
          "--replay", arguments.replay,
          "replays the network of a --log file: the same run gets the same verdicts; another run gets those of the "
          "last datagram recorded before, and after the end those of the start; excludes the other network options")
      .value_name("LOG.csv");
  command.add_flag("--check", arguments.check,
                   "only checks scene and network and prints every value in force, with units");
  command.add_flag("--verbose", arguments.verbose, "shows the network quality of every seat, not only of the worst");
  command.add_flag("--no-quality", arguments.no_quality, "does not judge the network");
  command.add_flag("--quiet", arguments.quiet, "no progress, and no summary beside --json -");
  command.footer(
      "The verdict fails when an invariant is broken that the chosen law and flow source mode promise, and only then. "
      "It is\n"
      "`not judged` when no hand moved or no errors could be measured.\n"
      "The network is judged separately, by the needs of force feedback (green, amber, red; loss, gaps and jitter in "
      "every\n"
      "100 ms, 1 s and 10 s of the session, round trips): it never changes the verdict.\n\n"
      "Exit: 0 pass or not judged, 1 fail or interrupted, 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim run free_motion\n"
      "  tandem-netsim run contact --delay 20 --jitter 5 --loss 5 --json -\n"
      "  tandem-netsim run free_motion --profile 5g --seed 7 --trace out.csv\n"
      "  tandem-netsim run contact --profile wifi-busy --log net.csv\n"
      "  tandem-netsim run contact --delay 20 --record lesson.mcap\n"
      "  tandem-netsim run contact --replay net.csv --channel raw\n"
      "  tandem-netsim run contact --delay 10 --script bad_day.textproto\n"
      "  tandem-netsim run free_motion --hand trainer=motion.csv,columns=baton\n"
      "  tandem-netsim run contact --hand trainer=lesson.mcap,seat=trainer");
}

}  // namespace tandem::netsim
