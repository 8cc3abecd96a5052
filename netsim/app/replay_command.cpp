#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/replay/recording_replay.h"
#include "server/session/build_text.h"

namespace tandem::netsim {
namespace {

constexpr std::uintmax_t kReplayedMax = std::uintmax_t{1} << 32;  // [bytes]

struct ReplayArguments {
  std::string recording, json;
};

int replay_usage_error(const std::string& mistake) { return io::report_usage_error("tandem-netsim replay", mistake); }

std::string difference_text(const ReplayDifference& d) {
  return format("tick %llu of the server, tick %u of the session, %s: recorded %s, replayed %s",
                static_cast<unsigned long long>(d.tick), static_cast<unsigned>(d.session_tick), d.channel.c_str(),
                d.recorded.c_str(), d.replayed.c_str());
}

/// What a reader needs to judge the result.
std::vector<std::string> replay_notes(const RecordingReplay& replay) {
  std::vector<std::string> notes;
  for (const std::string& build : replay.other_builds)
    notes.push_back("recorded by another build, which may compute other values: " + build + "; this program is " +
                    std::string(server::build_text()));
  if (replay.other_scene) notes.emplace_back("the inputs were recorded with another scene than the one in the file");
  if (!replay.complete) notes.emplace_back("the file has no undamaged end; what is whole was replayed");
  if (!replay.seats_compared)
    notes.emplace_back(
        "values of seats were not compared: the file has those of the hands themselves, before the network");
  return notes;
}

std::string replay_json(const RecordingReplay& replay, const std::vector<std::string>& notes) {
  nlohmann::ordered_json json{{"session", replay.session},
                              {"length_s", replay.length_s},
                              {"equal", replay.equal()},
                              {"error", replay.error},
                              {"difference", nullptr},
                              {"sessions", replay.counts.sessions},
                              {"ticks", replay.counts.ticks},
                              {"datagrams", replay.counts.datagrams},
                              {"outputs", replay.counts.outputs},
                              {"rows", replay.rows},
                              {"complete", replay.complete},
                              {"notes", notes}};
  if (const auto& d = replay.difference)
    json["difference"] = {{"tick", d->tick},
                          {"session_tick", d->session_tick},
                          {"channel", d->channel},
                          {"recorded", d->recorded},
                          {"replayed", d->replayed}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int replay_command(const ReplayArguments& arguments) {
  if (const auto problem = arguments.json == "-" ? std::string() : io::OutputFile::problem(arguments.json);
      !arguments.json.empty() && !problem.empty())
    return replay_usage_error("--json: " + problem);
  if (arguments.json == arguments.recording) return replay_usage_error("--json: is the recording itself");
  const auto bytes = read_whole_file(arguments.recording, kReplayedMax);
  if (!bytes) return replay_usage_error(bytes.error());
  const auto replay = replay_recording(bytes_of(*bytes));
  if (!replay) return replay_usage_error(arguments.recording + ": " + replay.error());
  io::OutputFile json;
  if (const auto problem = json.open(arguments.json, true); !problem.empty())
    return replay_usage_error("--json: " + problem);
  const auto notes = replay_notes(*replay);
  std::string text = arguments.recording + ": " + replay->session + format(", %.1f s: ", replay->length_s);
  if (replay->difference)
    text += "differs first at " + difference_text(*replay->difference) + "\n";
  else
    text +=
        (replay->equal() ? "equal, bit for bit: " : replay->error + "; equal until there: ") +
        format("%llu ticks, %llu datagrams received, %llu outputs, values of %llu ticks\n",
               static_cast<unsigned long long>(replay->counts.ticks),
               static_cast<unsigned long long>(replay->counts.datagrams),
               static_cast<unsigned long long>(replay->counts.outputs), static_cast<unsigned long long>(replay->rows));
  for (const std::string& note : notes) text += "note: " + note + "\n";
  io::print_formatted(json.on_stdout() ? stderr : stdout, "%s", text.c_str());
  json.write(replay_json(*replay, notes));
  if (const auto problem = json.close(); !problem.empty()) {
    io::print_formatted(stderr, "tandem-netsim replay: %s\n", problem.c_str());
    return io::kExitTrouble;
  }
  return replay->equal() ? io::kExitDone : io::kExitTrouble;
}

}  // namespace

void add_replay_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "replay", "Feeds the inputs of a recording into the server's core again: the outputs must be equal, bit for bit.",
      replay_command);
  command.add_option("recording", arguments.recording, "a recording (MCAP) with inputs, of run --record or of a server")
      .value_name("FILE.mcap")
      .required();
  command.add_option("--json", arguments.json, "writes the result; `-`: to standard output").value_name("FILE|-");
  command.footer(
      "Compares hashes of everything that each seat was sent, and the recorded values of each tick.\n"
      "The first difference is given with tick, channel and both values. A recording of another build may differ, and\n"
      "a note says so. A cut recording is replayed as far as it is whole.\n\n"
      "Exit: 0 equal, 1 different or inputs that were lost, 2 wrong arguments, or a file without inputs.\n\n"
      "Examples\n"
      "  tandem-netsim run contact --delay 20 --record lesson.mcap\n"
      "  tandem-netsim replay lesson.mcap");
}

}  // namespace tandem::netsim
