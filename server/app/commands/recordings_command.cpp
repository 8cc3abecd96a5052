#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "common/base/suggestions.h"
#include "common/io/command_line.h"
#include "server/app/commands/recordings_actions.h"
#include "server/app/commands/server_commands.h"
#include "server/app/commands/state_option.h"
#include "server/export/io/pending_path.h"

namespace tandem::server {
namespace {

struct RecordingsArguments {
  std::string action, dir, state, to, format, fps = "50", task, days, bytes;
  std::vector<std::string> names;
  bool yes = false, json = false, one_file = false, overwrite = false;
};

/// Names that an action takes.
enum class Names : std::uint8_t { kNone, kOne, kSome };

struct Action {
  const char* name;
  int (*run)(const RecordingsTask& task);
  Names names;
  const char* what;  ///< meaning of the names
  bool needs_folder;
};

constexpr std::array kActions{Action{"list", list_recordings, Names::kNone, "", true},
                              Action{"show", show_recordings, Names::kSome, "a recording of the folder", true},
                              Action{"export", export_recordings, Names::kSome, "a recording", false},
                              Action{"delete", delete_recordings, Names::kSome, "a recording of the folder", true},
                              Action{"retain", retain_recordings, Names::kNone, "", true},
                              Action{"forget-person", forget_person, Names::kOne, "the name of a person", true}};

constexpr std::array<std::pair<const char*, ExportFormat>, 4> kFormats{{{"csv", ExportFormat::kCsv},
                                                                        {"hdf5", ExportFormat::kHdf5},
                                                                        {"lerobot-v2.1", ExportFormat::kLerobot21},
                                                                        {"lerobot-v3.0", ExportFormat::kLerobot30}}};

constexpr double kDaysMax = 36500, kBytesMax = 1e18;
constexpr double kFramesPerSecondMax = 1000;

std::string folder_problem(const std::string& folder) {
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return {};
  return "\"" + folder + "\" is no folder; name the folder of the recordings";
}

/// The format that was named, or that belongs to the extension of the target.
void choose_format(const RecordingsArguments& arguments, RecordingsTask& task, io::UsageErrors& errors) {
  std::string name = arguments.format;
  const std::string extension = std::filesystem::path(arguments.to).extension().string();
  if (name.empty()) name = extension == ".csv" ? "csv" : extension == ".h5" || extension == ".hdf5" ? "hdf5" : "";
  if (name.empty()) {
    errors.add("--format is required: csv, hdf5, lerobot-v2.1 or lerobot-v3.0");
    return;
  }
  const auto found = std::ranges::find(kFormats, name, [](const auto& format) { return std::string(format.first); });
  if (found != kFormats.end()) task.format = found->second;
}

void parse_export(const RecordingsArguments& arguments, RecordingsTask& task, io::UsageErrors& errors) {
  choose_format(arguments, task, errors);
  const bool set = task.format == ExportFormat::kLerobot21 || task.format == ExportFormat::kLerobot30;
  task.to = arguments.to;
  task.task = arguments.task;
  if (arguments.to.empty()) {
    errors.add("--to is required: the file, or for a data set the new folder");
  } else {
    errors.add("--to", PendingPath::problem(arguments.to, set, arguments.overwrite));
  }
  task.one_file = arguments.one_file;
  if (!set && arguments.one_file && arguments.names.size() > 1)
    errors.add("NAME", "csv and hdf5 with --one-file take one file, not " + std::to_string(arguments.names.size()));
  std::string fps = arguments.fps;
  const std::string problem = io::whole_number_in(1, kFramesPerSecondMax)(fps);
  errors.add("--fps", problem);
  if (problem.empty()) task.fps = static_cast<unsigned>(std::stoul(fps));
}

void parse_retain(const RecordingsArguments& arguments, RecordingsTask& task, io::UsageErrors& errors) {
  if (arguments.days.empty() && arguments.bytes.empty()) errors.add("retain needs --days or --bytes, or both");
  task.limits.days = errors.optional_number("--days", arguments.days, 0.01, kDaysMax, "days");
  task.limits.bytes =
      static_cast<std::uint64_t>(errors.optional_number("--bytes", arguments.bytes, 1, kBytesMax, "bytes"));
}

int recordings_command(const RecordingsArguments& arguments) {
  io::UsageErrors errors;
  const auto action =
      std::ranges::find(kActions, arguments.action, [](const Action& a) { return std::string(a.name); });
  if (action == kActions.end()) {
    std::vector<std::string> known;
    for (const Action& a : kActions) known.emplace_back(a.name);
    return print_usage_error("recordings",
                             "ACTION: \"" + arguments.action + "\" is unknown; " + suggest(arguments.action, known));
  }
  RecordingsTask task;
  task.folder = arguments.dir;
  task.names = arguments.names;
  task.state = arguments.state;
  task.yes = arguments.yes;
  task.json = arguments.json;
  if (!arguments.dir.empty()) {
    errors.add("--dir", folder_problem(arguments.dir));
  } else if (action->needs_folder) {
    errors.add("--dir is required: the folder of the recordings");
  }
  if (action->names == Names::kNone && !arguments.names.empty())
    errors.add("NAME", std::string(action->name) + " takes no name");
  if (action->names != Names::kNone && arguments.names.empty())
    errors.add("NAME is required: " + std::string(action->what));
  if (action->names == Names::kOne && arguments.names.size() > 1)
    errors.add("NAME", std::string(action->name) + " takes one name; write a name with spaces in quotation marks");
  if (action->run == export_recordings) parse_export(arguments, task, errors);
  if (action->run == retain_recordings) parse_retain(arguments, task, errors);
  if (!errors.empty()) return print_usage_errors("recordings", errors);
  return action->run(task);
}

}  // namespace

void add_recordings_command(const io::Command& root) {
  const auto [command, arguments] =
      root.add_command("recordings", "Lists, exports and deletes the recordings of a folder.", recordings_command);
  command.add_option("ACTION", arguments.action, "list, show, export, delete, retain or forget-person")
      .value_name(" ")
      .required();
  command.add_option("NAME", arguments.names, "show, export, delete: recordings; forget-person: a person")
      .value_name(" ");
  command.add_option("--dir", arguments.dir, "folder of the recordings, with its index; required, but for export")
      .value_name("DIR")
      .group("Connection");
  add_state_option(command, arguments.state);
  command.add_option("--to", arguments.to, "export: the file to write, or for a data set the new folder")
      .value_name("FILE|DIR")
      .group("Export");
  command
      .add_option("--format", arguments.format,
                  "export: csv, hdf5, lerobot-v2.1 or lerobot-v3.0; default: by the name of the file")
      .value_name("FORMAT")
      .check(io::one_of({"csv", "hdf5", "lerobot-v2.1", "lerobot-v3.0"}))
      .group("Export");
  command
      .add_option("--fps", arguments.fps, "data sets: frames per second, a divisor of the session's rate; default 50")
      .value_name("N")
      .group("Export");
  command.add_option("--task", arguments.task, "data sets: subject of the lessons; default: the scene")
      .value_name("TEXT")
      .group("Export");
  command
      .add_flag("--one-file", arguments.one_file,
                "export: only the named files of a recording of several files, each as a lesson")
      .group("Export");
  command.add_flag("--overwrite", arguments.overwrite, "export: replaces a file of the name --to").group("Export");
  command.add_option("--days", arguments.days, "retain: recordings that are older are deleted [days]")
      .value_name("N")
      .group("Retention");
  command
      .add_option("--bytes", arguments.bytes,
                  "retain: the oldest recordings are deleted until the rest has at most so many bytes")
      .value_name("N")
      .group("Retention");
  command.add_flag("--yes", arguments.yes, "deletes; default: only prints what would be deleted");
  command.add_flag("--json", arguments.json, "list, show, delete, retain, forget-person: for machines");
  command.footer(
      "delete, retain and forget-person delete whole files, and only with --yes. forget-person deletes every recording "
      "with that person,\n"
      "also for the other persons in it; no name is replaced. Each deletion has a line in the audit log of the state "
      "folder, and none\n"
      "happens without it. Files that cannot be read are named and skipped. csv has the columns of --trace; hdf5 has "
      "one dataset per\n"
      "signal with its unit; a data set for LeRobot has one episode per recording and needs Node.js. A long session "
      "has "
      "several files,\n"
      "NAME.mcap, NAME-2.mcap and so on, which are one recording: of a named one, export finds the others in its "
      "folder.\n"
      "Exit: 0 done; 1 a file or the index cannot be read, written or deleted, or Ctrl-C; 2 wrong arguments.\n\n"
      "Examples\n"
      "  tandem-server recordings list --dir ./recordings\n"
      "  tandem-server recordings export lesson.mcap --to lesson.h5\n"
      "  tandem-server recordings export a.mcap b.mcap --dir ./recordings --to ./set --format lerobot-v3.0 --fps 50\n"
      "  tandem-server recordings retain --dir ./recordings --days 365 --bytes 50e9\n"
      "  tandem-server recordings forget-person \"Ada Byron\" --dir ./recordings --yes");
}

}  // namespace tandem::server
