#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "common/io/command_line.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "common/io/whole_file.h"
#include "netsim/app/exit_status.h"
#include "netsim/app/netsim_commands.h"
#include "netsim/app/what_if.h"
#include "netsim/replay/recording_replay.h"
#include "proto/recording/lesson_reader.h"
#include "server/archive/io/part_files.h"
#include "server/session/build_text.h"

namespace tandem::netsim {
namespace {

constexpr std::uintmax_t kReplayedMax = std::uintmax_t{1} << 32;  // [bytes]

struct ReplayArguments {
  std::vector<std::string> recordings;
  std::string json, what_if;
};

int replay_usage_error(const std::string& mistake) { return io::report_usage_error("tandem-netsim replay", mistake); }

std::string difference_text(const ReplayDifference& d) {
  return format("tick %llu of the server, tick %u of the session, %s: recorded %s, replayed %s",
                static_cast<unsigned long long>(d.tick), static_cast<unsigned>(d.session_tick), d.channel.c_str(),
                d.recorded.c_str(), d.replayed.c_str());
}

/// Facts that a reader needs to judge the result.
std::vector<std::string> replay_notes(const RecordingReplay& replay) {
  std::vector<std::string> notes;
  for (const std::string& build : replay.other_builds)
    notes.push_back("recorded by another build, which may compute other values: " + build + "; this program is " +
                    std::string(server::build_text()));
  if (replay.other_scene) notes.emplace_back("the inputs were recorded with another scene than the one in the file");
  if (!replay.complete) notes.emplace_back("a file has no undamaged end; its whole chunks were replayed");
  if (!replay.seats_compared)
    notes.emplace_back(
        "values of seats were not compared: the file has those of the hands themselves, before the network");
  if (replay.unseen > 0)
    notes.push_back(
        format("the recording begins after %llu ticks of its session, which were replayed unseen: of them, "
               "hashes of what the seats were sent were compared, and no values",
               static_cast<unsigned long long>(replay.unseen)));
  return notes;
}

std::string replay_json(const RecordingReplay& replay, std::size_t files, const std::vector<std::string>& notes) {
  nlohmann::ordered_json json{{"session", replay.session},
                              {"files", files},
                              {"length_s", replay.length_s},
                              {"equal", replay.equal()},
                              {"error", replay.error},
                              {"difference", nullptr},
                              {"sessions", replay.counts.sessions},
                              {"ticks", replay.counts.ticks},
                              {"datagrams", replay.counts.datagrams},
                              {"outputs", replay.counts.outputs},
                              {"rows", replay.rows},
                              {"unseen", replay.unseen},
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

std::string what_if_text(const WhatIfResult& result) {
  std::string text = result.words + format("\n%-20s %14s %14s\n", "", "recorded", "played");
  const auto number = [](double value) { return std::isfinite(value) ? format("%.6g", value) : std::string("-"); };
  for (const WhatIfNumber& n : result.numbers)
    text += format("%-20s %14s %14s\n", n.key.c_str(), number(n.recorded).c_str(), number(n.played).c_str());
  return text;
}

std::string what_if_json(const WhatIfResult& result) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json json{{"played_under", result.words}, {"numbers", nlohmann::ordered_json::object()}};
  for (const WhatIfNumber& n : result.numbers)
    json["numbers"][n.key] = {{"recorded", number(n.recorded)}, {"played", number(n.played)}};
  return json.dump(2) + "\n";
}

/// Prints the text, beside JSON on standard output to standard error, and writes the JSON.
/// @return exit code of the command
int write_results(const std::string& text, const std::string& json_text, io::OutputFile& json, bool good) {
  io::print_formatted(json.on_stdout() ? stderr : stdout, "%s", text.c_str());
  json.write(json_text);
  return exit_status("replay", {json.close()}, good);
}

int what_if(const ReplayArguments& arguments) {
  const auto other = parse_what_if(arguments.what_if);
  if (!other) return replay_usage_error("--what-if " + other.error());
  if (arguments.recordings.size() > 1)
    return replay_usage_error("--what-if plays one file, not " + std::to_string(arguments.recordings.size()) +
                              "; name one part of the session");
  const std::string& file = arguments.recordings[0];
  const auto bytes = io::read_whole_file(file, kReplayedMax);
  if (!bytes) return replay_usage_error(bytes.error());
  const auto lesson = read_lesson(bytes_of(*bytes));
  if (!lesson) return replay_usage_error(file + ": " + lesson.error());
  io::OutputFile json;
  if (const auto problem = json.open(arguments.json, true); !problem.empty())
    return replay_usage_error("--json: " + problem);
  const auto result = play_what_if(*lesson, *other);
  if (!result) return replay_usage_error(file + ": " + result.error());
  return write_results(file + ": hands played under " + what_if_text(*result), what_if_json(*result), json, true);
}

/// Replays the files of a recording, one after the other. @return why one cannot be replayed, with its name
std::expected<RecordingReplay, std::string> replay_parts(const std::vector<server::RecordedPart>& parts) {
  RecordingReplayer replayer;
  for (const server::RecordedPart& part : parts) {
    const auto bytes = io::read_whole_file(part.file, kReplayedMax);
    if (!bytes) return std::unexpected(bytes.error());
    if (const auto added = replayer.add(bytes_of(*bytes)); !added)
      return std::unexpected(part.file + ": " + added.error());
    if (replayer.ended()) break;
  }
  return replayer.finish();
}

int replay_command(const ReplayArguments& arguments) {
  if (const auto problem = arguments.json == "-" ? std::string() : io::OutputFile::problem(arguments.json);
      !arguments.json.empty() && !problem.empty())
    return replay_usage_error("--json: " + problem);
  if (std::ranges::find(arguments.recordings, arguments.json) != arguments.recordings.end())
    return replay_usage_error("--json: is the recording itself");
  if (!arguments.what_if.empty()) return what_if(arguments);
  const auto parts = server::find_parts(arguments.recordings);
  if (!parts) return replay_usage_error(parts.error());
  const auto replay = replay_parts(*parts);
  if (!replay) return replay_usage_error(replay.error());
  io::OutputFile json;
  if (const auto problem = json.open(arguments.json, true); !problem.empty())
    return replay_usage_error("--json: " + problem);
  const auto notes = replay_notes(*replay);
  std::string text = parts->front().file + ": " + replay->session;
  if (parts->size() > 1) text += format(", %zu parts", parts->size());
  text += format(", %.1f s: ", replay->length_s);
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
  return write_results(text, replay_json(*replay, parts->size(), notes), json, replay->equal());
}

}  // namespace

void add_replay_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "replay", "Feeds the inputs of a recording into the server's core again: the outputs must be equal, bit for bit.",
      replay_command);
  command
      .add_option("FILE.mcap", arguments.recordings,
                  "a recording with inputs, of run --record or of a server: all its parts, one part, or their folder")
      .value_name("...")
      .required();
  command.add_option("--json", arguments.json, "writes the result; `-`: to standard output").value_name("FILE|-");
  command.add_option("--what-if", arguments.what_if, what_if_help()).value_name("KEY=VALUE,...");
  command.footer(
      "Compares hashes of everything that each seat was sent, and the recorded values of each tick.\n"
      "The first difference is given with tick, channel and both values. A recording of another build may differ, and\n"
      "a note says so. A cut recording is replayed as far as it is whole. A long session has parts, NAME.mcap, "
      "NAME-2.mcap\n"
      "and so on: of one part, the others are looked for in its folder. A missing part is an error that names it.\n"
      "--what-if compares nothing: simulated hands of usual impedance follow the recorded motions in virtual time.\n\n"
      "Exit: 0 equal, 1 different or inputs that were lost, 2 wrong arguments, or a file without inputs.\n\n"
      "Examples\n"
      "  tandem-netsim run contact --delay 20 --record lesson.mcap\n"
      "  tandem-netsim replay lesson.mcap\n"
      "  tandem-netsim replay lab-20261126T134500Z-0f3a9c11.mcap lab-20261126T134500Z-0f3a9c11-2.mcap\n"
      "  tandem-netsim replay lesson.mcap --what-if law=set_position,delay=100");
}

}  // namespace tandem::netsim
