#include <string>
#include <vector>

#include "common/base/format.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "server/app/commands/server_commands.h"
#include "server/archive/app/lesson_file.h"
#include "server/recording/io/recording_repair.h"

namespace tandem::server {
namespace {

struct RepairArguments {
  std::vector<std::string> files;
};

/// Length of a recording in session time, as `recordings list` has it; empty if it cannot be read.
std::string length_text(const std::string& path) {
  const auto summary = load_summary(path);
  return summary ? format(", %.3f s of the session", summary->duration_s) : std::string();
}

int repair_command(const RepairArguments& arguments) {
  int code = io::kExitDone;
  for (const std::string& file : arguments.files) {
    const RecordingRepair repair = repair_recording(
        file, [&file](const std::string& progress) { io::print(stderr, file + ": " + progress + "\n"); });
    const bool good =
        repair.kind == RecordingRepair::Kind::kRepaired || repair.kind == RecordingRepair::Kind::kComplete;
    io::print(good ? stdout : stderr,
              (good ? "" : "tandem-server repair: ") + repair.text + (good ? length_text(repair.path) : "") + "\n");
    if (!good) code = io::kExitTrouble;
  }
  return code;
}

}  // namespace

void add_repair_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "repair", "Closes recordings that were cut by a power failure or a killed program.", repair_command);
  command.add_option("FILE", arguments.files, "recordings, NAME.mcap.part or NAME.mcap").value_name("...").required();
  command.footer(
      "Keeps all whole chunks and gives the file a new index and end. The original stays until the repaired file is\n"
      "complete on the disk; NAME.mcap.part then becomes NAME.mcap. A recording that a program writes now is not "
      "touched.\n"
      "A server repairs what it left itself when it starts again.\n"
      "Exit: 0 all files are complete; 1 a file is damaged beyond its begin, in use, or cannot be written, with the "
      "reason.\n\n"
      "Examples\n"
      "  tandem-server repair lesson.mcap.part\n"
      "  tandem-server repair /var/lib/tandem/recordings/lab-20261126T134500Z-0f3a9c11.mcap.part");
}

}  // namespace tandem::server
