#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "common/io/child_program.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "server/app/commands/server_commands.h"
#include "server/app/process/server_process.h"
#include "server/app/recording/replayed_lesson.h"
#include "server/archive/app/lesson_file.h"
#include "server/archive/io/part_files.h"

namespace tandem::server {
namespace {

namespace fs = std::filesystem;

constexpr double kHandsTimeoutS = 30;  // for the recorded hands to join

struct ReplayLiveArguments {
  std::string file, listen = "127.0.0.1:0", json, record, wait;
  std::vector<std::string> seats;
  bool quiet = false, no_wait = false;
};

/// Folder for the motions, which only this user may read; deleted at the end.
class MotionFolder {
 public:
  MotionFolder() {
    std::string name = (fs::temp_directory_path() / "tandem-replay-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~MotionFolder() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  MotionFolder(const MotionFolder&) = delete;
  MotionFolder& operator=(const MotionFolder&) = delete;
  /// @return path of the file; empty: it cannot be written
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    if (path_.empty()) return {};
    std::ofstream file(path_ + "/" + name, std::ios::binary);
    file << text;
    file.close();
    return file ? path_ + "/" + name : std::string();
  }

 private:
  std::string path_;
};

/// The recorded hands: simulated seats of tandem-client, which move as recorded.
class ReplayedHands {
 public:
  /// @return the error
  [[nodiscard]] std::string prepare(const std::vector<ReplayedHand>& hands) {
    client_ = io::program_path("tandem-client");
    if (client_.empty()) return "tandem-client is neither beside this program nor in $PATH";
    for (const ReplayedHand& hand : hands) {
      const std::string file = folder_.write(hand.seat + ".csv", hand.csv);
      if (file.empty())
        return "the motion of seat " + hand.seat + " cannot be written to the folder for temporary files";
      files_.emplace_back(hand.seat, file);
    }
    return {};
  }
  void join(const std::string& address) {
    for (const auto& [seat, file] : files_) {
      auto child = io::ChildProgram::start(
          "the recorded hand of " + seat,
          {client_, "join", "--server", address, "--seat", seat, "--device",
           "sim:motion=" + file + ",scale=1,middle=keep", "--quiet", "--reconnect-timeout", "0"});
      if (child) {
        children_.push_back(std::move(*child));
      } else {
        failure_ = child.error();
      }
    }
  }
  /// Why a hand did not play; empty: all did.
  [[nodiscard]] std::string failure() {
    for (io::ChildProgram& child : children_)
      if (child.failed()) {
        const std::string said = child.last_output();
        failure_ = child.name() + " ended by itself" + (said.empty() ? "" : ": " + said);
      }
    return failure_;
  }

 private:
  MotionFolder folder_;
  std::string client_, failure_;
  std::vector<std::pair<std::string, std::string>> files_;
  std::vector<io::ChildProgram> children_;
};

/// Reads a recording with all its files. @return the lesson; or the error, with the name of the file of several
std::expected<Lesson, std::string> read_recording(const std::string& path) {
  if (std::error_code error; std::filesystem::is_directory(path, error))
    return std::unexpected("is a folder; name a recording");
  const auto lesson = load_lesson(path);  // first, for an error that names no other file
  if (!lesson) return lesson;
  const auto parts = find_parts({path});
  if (!parts) return std::unexpected(parts.error());
  if (parts->size() == 1) return lesson;
  std::vector<std::string> files;
  for (const RecordedPart& part : *parts) files.push_back(part.file);
  return load_lesson(files);
}

int replay_live_command(const ReplayLiveArguments& arguments) {
  io::UsageErrors errors;
  ServerOptions plan{.command = "replay-live", .quiet = arguments.quiet, .no_restore = true};
  SessionOptions& session = plan.sessions.emplace_back(SessionOptions{.json = arguments.json});
  const auto lesson = read_recording(arguments.file);
  auto replayed = lesson ? replayed_lesson(*lesson, arguments.seats, !arguments.no_wait)
                         : std::expected<ReplayedLesson, std::string>(std::unexpected(lesson.error()));
  if (!replayed) {
    errors.add(arguments.file, replayed.error());
  } else {
    session.scene_duration = lesson->scene.duration;
    session.scene = std::move(replayed->scene);
    session.name = session.scene.name;
    for (const ReplayedHand& hand : replayed->hands) session.replayed.push_back(hand.seat);
    // People take their time; hands of programs do not.
    if (replayed->awaited.empty()) plan.start_timeout_s = kHandsTimeoutS;
  }
  if (!arguments.wait.empty())
    plan.start_timeout_s = errors.optional_number("--start-timeout", arguments.wait, 0.1, 3e6, "s");
  const auto listen = io::parse_address(arguments.listen, 0);
  if (!listen) {
    errors.add("--listen", listen.error());
  } else if (!listen->loopback()) {
    errors.add("--listen " + arguments.listen, "must be an address of this computer, such as 127.0.0.1:7000");
  } else {
    plan.control.listen = *listen;
  }
  errors.output_file("--json", session.json);
  session.record.target = arguments.record;
  if (!arguments.record.empty()) errors.add("--record " + arguments.record, recording_target_problem(arguments.record));
  if (!errors.empty()) return errors.report("tandem-server replay-live");
  ReplayedHands hands;
  if (const std::string problem = hands.prepare(replayed->hands); !problem.empty()) {
    io::print(stderr, "tandem-server replay-live: " + problem + "\n");
    return io::kExitTrouble;
  }
  if (const std::string late = late_begin_text(*lesson); !late.empty())
    io::print(stderr, "tandem-server replay-live: " + late + "\n");
  plan.on_listening = [&hands](const std::string& address) { hands.join(address); };
  plan.start_problem = [&hands] { return hands.failure(); };
  const int code = run_server(plan);
  const std::string failure = hands.failure();
  if (failure.empty()) return code;
  io::print(stderr, "tandem-server replay-live: " + failure + "\n");
  return io::kExitTrouble;
}

}  // namespace

void add_replay_live_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "replay-live",
      "Serves a recorded lesson live: recorded hands move their seats again, others may join and feel it.",
      replay_live_command);
  command.add_option("FILE", arguments.file, "a recording, NAME.mcap").value_name(" ").required();
  command
      .add_option("--seat", arguments.seats,
                  "plays only this seat; may be repeated; default: every seat that was engaged. The replay begins when "
                  "the other seats that the scene requires are taken")
      .value_name("NAME")
      .one_value();
  command
      .add_option("--listen", arguments.listen,
                  "address of this computer at which clients join; port 0 takes a free one; default 127.0.0.1:0")
      .value_name("HOST:PORT");
  command.add_flag("--no-wait", arguments.no_wait,
                   "with --seat: begins when the recorded hands are there; all other seats are optional");
  command
      .add_option(
          "--start-timeout", arguments.wait,
          "gives up after this many seconds [s] if required seats are missing; default: no limit while it waits "
          "for other clients, else 30")
      .value_name("S");
  command.add_option("--json", arguments.json, "writes the report of the new session").value_name("FILE|-");
  command.add_option("--record", arguments.record, "records the new session").value_name("FILE.mcap|DIR");
  command.add_flag("--quiet", arguments.quiet, "no status and no summary");
  command.footer(
      "The session has the scene of the recording, with its law, limits and force gates: it is energy-safe like any\n"
      "other. Recorded hands are simulated seats (tandem-client join --device sim:motion=...) that move as recorded, "
      "in "
      "session\n"
      "time. Authority follows the timeline of the scene; orders of the recorded session are not repeated. It ends "
      "with "
      "the recording.\n"
      "Exit: as `run`; 1 also if a recorded hand could not join.\n\n"
      "Examples\n"
      "  tandem-server replay-live lesson.mcap --seat trainer --listen 127.0.0.1:7000\n"
      "  tandem-client join --server 127.0.0.1:7000 --seat trainee --device sim:keyboard\n"
      "  tandem-server replay-live lesson.mcap --seat trainer --no-wait");
}

}  // namespace tandem::server
