#include "common/base/raw_bytes.h"
#include "common/io/command_line.h"
#include "common/io/exit_code.h"
#include "common/io/output_file.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "common/io/whole_file.h"
#include "netsim/app/netsim_commands.h"
#include "proto/recording/lesson_reader.h"
#include "server/recording/lesson_record.h"
#include "server/report/trace_csv.h"

namespace tandem::netsim {
namespace {

constexpr std::uintmax_t kRecordingMax = std::uintmax_t{1} << 32;  // [bytes]
constexpr std::size_t kRowsWrittenAtOnce = 60'000;                 // [bytes]

struct TraceArguments {
  std::string recording, output;
};

int trace_command(const TraceArguments& arguments) {
  io::UsageErrors mistakes;
  if (arguments.output != "-") mistakes.add("--output", io::OutputFile::problem(arguments.output));
  if (arguments.output == arguments.recording) mistakes.add("--output: is the recording itself");
  if (!mistakes.empty()) return mistakes.report_each("tandem-netsim trace");
  const auto bytes = io::read_whole_file(arguments.recording, kRecordingMax);
  if (!bytes) return io::report_usage_error("tandem-netsim trace", bytes.error());
  const auto lesson = read_lesson(bytes_of(*bytes));
  if (!lesson) return io::report_usage_error("tandem-netsim trace", arguments.recording + ": " + lesson.error());
  io::OutputFile output;
  if (const auto problem = output.open(arguments.output, true); !problem.empty())
    return io::report_usage_error("tandem-netsim trace", "--output: " + problem);
  if (!lesson->complete)
    io::print_formatted(stderr, "note: %s has no undamaged end; the trace holds what is whole, %zu ticks\n",
                        arguments.recording.c_str(), lesson->rows());
  const server::TraceCsv csv{lesson->scene};
  std::string rows = csv.header();
  server::TickRecord record;
  for (std::size_t row = 0; row < lesson->rows(); ++row) {
    fill_record(*lesson, row, record);
    if (record.running) csv.append(record, rows);
    if (rows.size() < kRowsWrittenAtOnce) continue;
    output.write(rows);
    rows.clear();
  }
  output.write(rows);
  if (const auto problem = output.close(); !problem.empty()) {
    io::print_formatted(stderr, "tandem-netsim trace: %s\n", problem.c_str());
    return io::kExitTrouble;
  }
  return io::kExitDone;
}

}  // namespace

void add_trace_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "trace", "Writes the trace of a recording as CSV: the same table as `run --trace`.", trace_command);
  command.add_option("recording", arguments.recording, "a recording (MCAP) of run --record or of tandem-server")
      .value_name("FILE.mcap")
      .required();
  command.add_option("--output", arguments.output, "writes the trace there; `-`: to standard output")
      .value_name("FILE.csv|-")
      .required();
  command.footer(
      "A cut recording gives the rows of its whole chunks, with a note.\n\n"
      "Exit: 0 done, 1 trouble while writing, 2 wrong arguments, or a file that is no recording.\n\n"
      "Examples\n"
      "  tandem-netsim run contact --record lesson.mcap\n"
      "  tandem-netsim trace lesson.mcap --output lesson.csv");
}

}  // namespace tandem::netsim
