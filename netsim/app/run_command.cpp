#include "netsim/app/run_command.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>

#include "common/link/digest.h"
#include "hal/io/motion_file.h"
#include "netsim/app/network_options.h"
#include "common/io/number_option.h"
#include "netsim/world_report.h"
#include "proto/io/scene_file.h"
#include "proto/scene_text.h"
#include "server/report_summary.h"
#include "server/session_monitor.h"
#include "server/trace_csv.h"

namespace tandem::netsim {
namespace {

constexpr int kFailed = 1, kTrouble = 1, kWrong = 2;

struct RunArguments {
  std::string scene, channel, mfs, json, trace;
  std::vector<std::string> hands;
  double duration_s = 0;
  bool check = false, quiet = false;
  NetworkOptions network;
};

std::atomic<bool> interrupted{false};

int wrong(const std::string& message) {
  std::fprintf(stderr, "tandem-netsim run: %s\n", message.c_str());
  return kWrong;
}

/// Everything a person typed, turned into a setup; or all that is wrong with it.
std::expected<WorldSetup, std::string> understand(const RunArguments& arguments, const NetworkChoice& network) {
  WorldSetup setup;
  std::string problems;
  if (auto scene = load_scene(arguments.scene)) {
    setup.scene = std::move(*scene);
  } else {
    return std::unexpected(to_text(scene.error()));
  }
  if (arguments.duration_s > 0) setup.scene.duration = arguments.duration_s;
  if (arguments.channel == "raw") setup.scene.channel.law = LawKind::kRaw;
  if (arguments.channel == "set_position") setup.scene.channel.law = LawKind::kSetPosition;
  for (const MfsMode mode : {MfsMode::kOpen, MfsMode::kTank, MfsMode::kSeed, MfsMode::kSeedSigned})
    if (arguments.mfs == server::mfs_name(mode)) setup.scene.channel.mfs = mode;
  for (const std::string& text : arguments.hands) {
    const auto cut = text.find('=');
    const std::string seat = text.substr(0, cut);
    const auto known = std::ranges::find_if(
        setup.scene.seats, [&](const SeatSpec& s) { return s.name == seat && s.kind == SeatKind::kMaster; });
    if (cut == std::string::npos || known == setup.scene.seats.end()) {
      problems += "--hand " + text + ": must be SEAT=FILE.csv[,...] with SEAT one of:";
      for (const SeatSpec& s : setup.scene.seats)
        if (s.kind == SeatKind::kMaster) problems += " " + s.name;
      problems += "\n";
      continue;
    }
    const auto options = hal::sim::parse_motion_options(text.substr(cut + 1));
    if (!options) {
      problems += "--hand " + seat + ": " + options.error() + "\n";
      continue;
    }
    if (auto motion = hal::load_motion(*options)) {
      if (!arguments.quiet) std::fprintf(stderr, "%s: %s\n", seat.c_str(), (*motion)->describe().c_str());
      setup.motions[seat] = std::move(*motion);
    } else {
      problems += motion.error() + "\n";
    }
  }
  setup.network = network.link;
  setup.seed = arguments.network.seed();
  if (!problems.empty()) return std::unexpected(problems);
  return setup;
}

/// Progress on a terminal, once per virtual second.
void show_progress(const World& world) {
  std::fprintf(stderr, "\r\x1b[K%5.1f / %.1f s", world.session().time(), world.scene().duration);
  std::fflush(stderr);
}

int run_command(const RunArguments& arguments) {
  const auto network = arguments.network.resolve();
  if (!network) return wrong(network.error());
  auto setup = understand(arguments, *network);
  if (!setup) return wrong(setup.error());
  if (arguments.check) {
    std::fputs(effective_scene_text(setup->scene).c_str(), stdout);
    return 0;
  }
  const bool json_on_stdout = arguments.json == "-";
  std::ofstream json_file, trace_file;
  if (!arguments.json.empty() && !json_on_stdout) {
    json_file.open(arguments.json);
    if (!json_file) return wrong("--json: " + arguments.json + " cannot be written");
  }
  if (!arguments.trace.empty()) {
    trace_file.open(arguments.trace, std::ios::binary);
    if (!trace_file) return wrong("--trace: " + arguments.trace + " cannot be written");
  }
  auto made = World::make(*setup);
  if (!made) return wrong(made.error());
  World& world = **made;

  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  const bool progress = !arguments.quiet && isatty(STDERR_FILENO) != 0;
  const std::clock_t begin = std::clock();
  server::ReportBuilder builder{world.scene()};
  const server::TraceCsv csv{world.scene()};
  link::Digest digest;
  std::string rows = csv.header();
  const auto flush = [&] {
    digest.add(rows);
    if (trace_file.is_open()) trace_file.write(rows.data(), static_cast<std::streamsize>(rows.size()));
    rows.clear();
  };
  for (std::uint64_t n = 0; world.step() && !interrupted; ++n) {
    const server::TickRecord& record = world.record();
    builder.add(record);
    if (record.running) csv.append(record, rows);
    if (rows.size() > 60'000) flush();
    if (progress && n % 1000 == 0) show_progress(world);
  }
  flush();
  if (progress) std::fprintf(stderr, "\r\x1b[K");
  if (!world.trouble().empty()) {
    std::fprintf(stderr, "tandem-netsim run: %s\n", world.trouble().c_str());
    return kTrouble;
  }

  server::RunReport report = world_report(world, builder, setup->seed);
  report.trace_hash = digest.hex();
  report.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (interrupted) std::fprintf(stderr, "interrupted at %.3f s; what follows judges that much\n", world.session().time());
  if (!arguments.quiet || !json_on_stdout)
    std::fprintf(json_on_stdout ? stderr : stdout, "%s: %s, %.1f s over %s, seed %llu, %.0f x real time\n%s",
                 report.scenario.c_str(), report.passed ? "pass" : "FAIL", report.duration_s, network->description.c_str(),
                 static_cast<unsigned long long>(report.seed), report.cpu_s > 0 ? report.duration_s / report.cpu_s : 0.0,
                 server::report_summary(report, world.scene()).c_str());
  trace_file.close();
  if (!arguments.trace.empty() && !trace_file) {
    std::fprintf(stderr, "tandem-netsim run: --trace: %s could not be written to the end\n", arguments.trace.c_str());
    return kTrouble;
  }
  if (!arguments.json.empty()) {
    const std::string json = server::to_json(report);
    if (json_on_stdout) {
      std::fputs(json.c_str(), stdout);
    } else {
      json_file << json;
      json_file.close();
      if (!json_file) {
        std::fprintf(stderr, "tandem-netsim run: --json: %s could not be written to the end\n", arguments.json.c_str());
        return kTrouble;
      }
    }
  }
  return report.passed ? 0 : kFailed;
}

}  // namespace

void add_run_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* const command =
      root.add_subcommand("run", "Runs a whole session in virtual time: the same server and client cores, seeded.");
  command->add_option("scene", arguments->scene, "a scene file, or the name of a shipped scene (tandem-server scenes)")
      ->option_text("SCENE")
      ->required();
  arguments->network.add_to(*command);
  command
      ->add_option("--hand", arguments->hands,
                   "a recorded motion moves this seat's hand: SEAT=FILE.csv[,columns=PREFIX][,rec=N][,scale=auto|S]"
                   "[,axes=+x+y+z][,end=hold|loop]; may be repeated")
      ->option_text("SEAT=FILE...")
      ->allow_extra_args(false);
  command->add_option("--channel", arguments->channel, "channel law instead of the scene's")
      ->check(CLI::IsMember({"set_position", "raw"}));
  command->add_option("--mfs", arguments->mfs, "flow source mode instead of the scene's")
      ->check(CLI::IsMember({"open", "tank", "seed", "seed_signed"}));
  command->add_option("--duration", arguments->duration_s, "session time instead of the scene's")
      ->check(io::number_in(0.1, 3e6, "s"))
      ->option_text("S");
  command->add_option("--json", arguments->json, "writes the report; `-`: to standard output")->option_text("FILE|-");
  command->add_option("--trace", arguments->trace, "writes one row per tick; the same seed and build give the same bytes")
      ->option_text("FILE.csv");
  command->add_flag("--check", arguments->check, "only checks the scene and prints every value in force, with units");
  command->add_flag("--quiet", arguments->quiet, "no progress, and no summary beside --json -");
  command->footer(
      "The verdict fails when an invariant is broken that the chosen law and flow source mode promise, and only then.\n"
      "Exit: 0 pass, 1 fail, 2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim run free_motion\n"
      "  tandem-netsim run contact --delay 20 --jitter 5 --loss 5 --json -\n"
      "  tandem-netsim run free_motion --profile 5g --seed 7 --trace out.csv\n"
      "  tandem-netsim run free_motion --hand trainer=motion.csv,columns=baton");
  command->callback([arguments, &action] { action = [arguments] { return run_command(*arguments); }; });
}

}  // namespace tandem::netsim
