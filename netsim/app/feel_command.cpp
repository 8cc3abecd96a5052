#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/base/format.h"
#include "common/base/suggestions.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/terminal.h"
#include "common/io/usage_errors.h"
#include "common/setup/channel_factory.h"
#include "hal/io/motion_file.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/feel_measure.h"
#include "netsim/app/law_options.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/signal_watcher.h"
#include "netsim/app/test_progress.h"
#include "netsim/profiles/app/network_options.h"
#include "proto/io/scene_file.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kRecordingsMax = 8;

struct FeelArguments {
  std::string scene, channel, coupling, mfs, contacts, probes, recordings, json, csv;
  std::vector<std::string> hands, limits;
  double seeds = 20, jobs = 0;
  double assist = -1;  ///< [N]; below 0: that of the scene
  bool assist_in_contact = false;
  bool plain = false, quiet = false;
  NetworkOptions network;
};

std::vector<Probe> probes_named(const std::string& text, io::UsageErrors& mistakes) {
  std::vector<Probe> out;
  std::vector<std::string> known;
  for (const ProbeName& one : kProbes) known.emplace_back(one.name);
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    if (text.empty()) break;
    const auto it = std::ranges::find(kProbes, word, &ProbeName::name);
    if (it == kProbes.end()) {
      mistakes.add("--probe: no probe is called \"" + word + "\"; " + suggest(word, known));
    } else if (std::ranges::find(out, it->probe) == out.end()) {
      out.push_back(it->probe);
    }
  }
  if (text.empty())
    for (const ProbeName& one : kProbes) out.push_back(one.probe);
  return out;
}

void add_recording(const std::string& text, FeelSetup& setup, io::UsageErrors& mistakes, const char* option) {
  const auto options = hal::sim::parse_motion_options(text);
  if (!options) return mistakes.add(std::string(option) + ": " + options.error());
  auto motion = hal::load_motion(*options);
  if (!motion) return mistakes.add(motion.error());
  setup.recordings.push_back({text, std::move(*motion)});
}

/// Adds every recording of a folder that needs no further options; names the others in `notes`.
void add_folder(const FeelArguments& a, FeelSetup& setup, io::UsageErrors& mistakes, std::vector<std::string>& notes) {
  if (a.recordings.empty()) return;
  std::error_code error;
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(a.recordings, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("motion_") && name.ends_with(".csv")) files.push_back(entry.path().string());
  }
  if (error) return mistakes.add("--recordings: " + a.recordings + ": " + error.message());
  std::ranges::sort(files);
  std::size_t read = 0;
  for (const std::string& file : files) {
    const auto options = hal::sim::parse_motion_options(file);
    auto motion = options ? hal::load_motion(*options) : std::unexpected(options.error());
    if (motion) {
      setup.recordings.push_back({file, std::move(*motion)});
      ++read;
    } else {
      notes.push_back("left out: " + motion.error() + "; name it by --hand");
    }
  }
  if (read == 0)
    mistakes.add("--recordings: " + a.recordings + " holds no motion_*.csv that can be read without options");
}

/// @return the error; empty if there is none
std::string set_contacts(const FeelArguments& a, SceneSpec& scene) {
  if (a.contacts.empty()) return {};
  if (scene.channel.law != LawKind::kReplica)
    return "is for law REPLICA, under which clients simulate the tool; add --channel replica";
  if (!scene.tools[0].remote)
    return "is for tools that a SLAVE seat serves; the first tool of " + a.scene + " has a slave of its own";
  scene.tools[0].contacts = a.contacts == "none" ? ContactsMode::kNone : ContactsMode::kEstimated;
  return {};
}

/// @return the error; empty if there is none
std::string set_assist(const FeelArguments& a, SceneSpec& scene) {
  if (a.assist < 0) return a.assist_in_contact ? "--assist-in-contact: needs --assist, the largest force" : "";
  if (a.assist > 0 && scene.channel.law != LawKind::kReplica)
    return "--assist: is for law REPLICA, under which clients know the leader's hand; add --channel replica";
  for (SeatSpec& seat : scene.seats)
    if (seat.kind == SeatKind::kMaster) seat.assist = {a.assist, a.assist_in_contact};
  return {};
}

int feel_command(const FeelArguments& a) {
  io::UsageErrors mistakes;
  FeelSetup feel{.scene = {}};
  FeelReport report;
  feel.hands = a.plain ? HandKind::kPlain : HandKind::kDrawn;
  if (auto network = a.network.resolve()) {
    feel.network = network->link;
    report.network = network->description;
    report.notes = network->notes;
  } else {
    mistakes.add(network.error());
  }
  if (auto scene = load_scene(a.scene)) {
    feel.scene = std::move(*scene);
    set_coupling(feel.scene, a.coupling);
    set_law(feel.scene, a.channel, a.mfs);
    mistakes.add("--contacts", set_contacts(a, feel.scene));
    mistakes.add(set_assist(a, feel.scene));
    mistakes.add(law_option(a.channel, a.coupling), law_conflict(feel.scene, a.scene));
  } else {
    mistakes.add(to_text(scene.error()));
  }
  FeelOptions options{.first = a.network.seed(),
                      .seeds = static_cast<std::uint64_t>(a.seeds),
                      .probes = probes_named(a.probes, mistakes),
                      .jobs = static_cast<std::size_t>(a.jobs)};
  for (const std::string& text : a.hands) add_recording(text, feel, mistakes, "--hand");
  add_folder(a, feel, mistakes, report.notes);
  if (feel.recordings.size() > kRecordingsMax) mistakes.add(format("--hand: at most %zu recordings", kRecordingsMax));
  for (const std::string& text : a.limits) {
    if (auto limit = parse_feel_limit(text)) {
      report.limits.push_back(std::move(*limit));
    } else {
      mistakes.add("--limit: " + limit.error());
    }
  }
  for (const auto& [option, file] : {std::pair{"--json", &a.json}, {"--csv", &a.csv}})
    mistakes.output_file(option, *file);
  if (!a.json.empty() && a.json == a.csv) mistakes.add("--csv: is the same file as --json");
  for (const std::string& other : a.network.all_given())
    if (other == "--script") mistakes.add("--script: a probe is too short for a script; name one network");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim feel");

  const SignalWatcher interruption;
  io::OutputFile json_file, csv_file;
  if (const auto problem = json_file.open(a.json, true); !problem.empty())
    return io::report_usage_error("tandem-netsim feel", "--json: " + problem);
  if (const auto problem = csv_file.open(a.csv, true); !problem.empty())
    return io::report_usage_error("tandem-netsim feel", "--csv: " + problem);
  report.scene = a.scene;
  report.spec = feel.scene;
  report.channel = setup::law_name(feel.scene.channel.law);
  if (feel.scene.channel.coupling != HandCouplingKind::kEsc)
    report.channel +=
        ", coupling " + std::string(control::row_of(setup::hand_coupling(feel.scene.channel.coupling)).name);
  report.plain_hands = a.plain;
  for (const auto& recording : feel.recordings) report.recordings.push_back(recording.name);
  io::StatusLine line{a.quiet || isatty(STDERR_FILENO) == 0};
  options.stop_fd = interruption.fd();
  options.on_progress = [&](const io::JobProgress& p) {
    if (!line.wanted()) return;
    line.show(format("%3.0f %%  %zu of %zu probes done", 100 * p.share, p.done, p.count) + left_text(p));
  };
  measure_feel(feel, options, report);
  line.clear();

  const bool on_stdout = a.json == "-" || a.csv == "-";
  if (!a.quiet || !on_stdout) io::print(on_stdout ? stderr : stdout, feel_text(report));
  const bool interrupted = report.interrupted && interruption.signalled();
  if (interrupted) SignalWatcher::report("feel", format("%zu of %.0f seeds", report.seeds.size(), a.seeds));
  json_file.write(feel_json(report));
  csv_file.write(feel_csv(report));
  return exit_status("tandem-netsim feel", {json_file.close(), csv_file.close()}, !interrupted && report.passed());
}

}  // namespace

void add_feel_command(const io::Command& root) {
  const auto [command, a] = root.add_command(
      "feel", "Measures what hands feel with a scene's settings over a network: stiffness, drag, errors, oscillation.",
      feel_command);
  command
      .add_option(
          "scene", a.scene,
          "a scene file, or the name of a shipped scene; its channel, coupling, gate, devices and first tool are used")
      .value_name(" ")
      .required();
  a.network.add_to(command);
  command.add_option("--seeds", a.seeds, "how many seeds, from --seed on; each has other hands; default 20")
      .check(io::whole_number_in(1, 10'000))
      .value_name("N");
  command.add_option("--jobs", a.jobs, "probes at a time; default: one per core. No number depends on it")
      .check(io::whole_number_in(1, 256))
      .value_name("N");
  command
      .add_option("--probe", a.probes,
                  "only these: press, free, gain, rest, release, handover, share, follow; default: all")
      .value_name("NAME,...");
  command
      .add_option(
          "--hand", a.hands,
          "a recorded motion for the probe `free`: FILE.csv[,columns=PREFIX][,rec=N][,scale=auto|S]; may be repeated")
      .value_name("FILE...")
      .one_value();
  command.add_option("--recordings", a.recordings, "a folder: every motion_*.csv in it that needs no options")
      .value_name("DIR");
  command.add_flag("--plain-hands", a.plain, "hands without tremor and noise, all with the same impedance");
  command.add_option("--channel", a.channel, law_help()).check(io::one_of(law_names()));
  command.add_option("--coupling", a.coupling, coupling_help()).check(io::one_of(coupling_names()));
  command
      .add_option("--contacts", a.contacts,
                  "how hands feel contacts of a SLAVE seat's device, instead of the scene's tool { contacts }: "
                  "estimated, none")
      .check(io::one_of({"estimated", "none"}));
  command
      .add_option("--assist", a.assist,
                  "largest force that pulls following hands towards the leader's, instead of the scene's seat { assist "
                  "}; 0: none")
      .check(io::number_in(0, 3, "N"))
      .value_name("N");
  command.add_flag("--assist-in-contact", a.assist_in_contact, "applies that force in contact too");
  command.add_option("--mfs", a.mfs, "flow sources instead of the scene's: open, tank, seed, seed_signed")
      .check(io::one_of({"open", "tank", "seed", "seed_signed"}));
  command
      .add_option("--limit", a.limits,
                  "limit of a mean, in SI units; the worst seed may be 1.5 times worse: KEY<=NUMBER or "
                  "KEY>=NUMBER; may be repeated")
      .value_name("LIMIT")
      .one_value();
  command.add_option("--json", a.json, "writes all numbers and seeds; `-`: to standard output").value_name("FILE|-");
  command.add_option("--csv", a.csv, "writes one row per number; `-`: to standard output").value_name("FILE|-");
  command.add_flag("--quiet", a.quiet, "no progress, and no table beside --json - or --csv -");
  command.footer(
      "Every number is the mean and the worst over the seeds. Hands have drawn tremor (8 to 12 Hz), intention noise "
      "(0.3 mm RMS\n"
      "about 2.3 Hz) and impedance. The probes do not know the law.\n\n"
      "Exit: 0 measured and every --limit holds, 1 a limit is broken, something could not be measured, or "
      "interrupted,\n"
      "2 wrong arguments or files.\n\n"
      "Examples\n"
      "  tandem-netsim feel contact --delay 50\n"
      "  tandem-netsim feel contact --profile wifi-busy --probe press,free --json feel.json\n"
      "  tandem-netsim feel contact --delay 100 --limit 'stiffness_felt_n_m>=360' --limit 'drag_1hz_n<=0.15'\n"
      "  tandem-netsim feel contact_remote --channel replica --contacts none --delay 50 --probe press\n"
      "  tandem-netsim feel contact --delay 20 --probe free --hand motion.csv,columns=baton");
}

}  // namespace tandem::netsim
