#include <cstdio>
#include <filesystem>

#include "common/base/sanitize.h"
#include "common/io/print.h"
#include "server/app/commands/long_work.h"
#include "server/app/commands/recordings_actions.h"
#include "server/app/commands/state_option.h"
#include "server/archive/app/lesson_file.h"
#include "server/archive/recording_row.h"
#include "server/export/app/csv_export.h"
#include "server/export/app/lerobot_export.h"
#include "server/export/io/hdf5_export.h"
#include "server/export/lesson_records.h"

namespace tandem::server {
namespace {

/// Reads a lesson that can be exported. @return the lesson, or the error with the name of the file
std::expected<Lesson, std::string> read_exportable(const std::string& file) {
  auto lesson = load_lesson(file);
  if (!lesson) return std::unexpected(sanitize(file) + ": " + lesson.error());
  if (const std::string problem = lesson_problem(*lesson); !problem.empty())
    return std::unexpected(sanitize(file) + ": " + problem);
  const RecordingSummary summary = summary_of(*lesson);
  if (summary.missing_ticks > 0)
    io::print_formatted(stderr, "%s: %llu ticks are missing; the export has no rows for them\n", sanitize(file).c_str(),
                        static_cast<unsigned long long>(summary.missing_ticks));
  if (!summary.complete)
    io::print_formatted(stderr, "%s: the end is missing, or a part is damaged\n", sanitize(file).c_str());
  return lesson;
}

std::string export_files(const RecordingsTask& task, const std::vector<std::string>& files,
                         const ExportProgress& progress) {
  if (task.format == ExportFormat::kLerobot21 || task.format == ExportFormat::kLerobot30) {
    LerobotRequest request;
    request.version = task.format == ExportFormat::kLerobot21 ? LerobotVersion::k21 : LerobotVersion::k30;
    request.fps = task.fps;
    request.task = task.task;
    request.episodes = files.size();
    request.lesson = [&files](std::size_t episode) { return read_exportable(files[episode]); };
    return export_lerobot(request, task.to, progress);
  }
  const auto lesson = read_exportable(files.front());
  if (!lesson) return lesson.error();
  return (task.format == ExportFormat::kCsv ? export_csv : export_hdf5)(*lesson, task.to, progress);
}

}  // namespace

int export_recordings(const RecordingsTask& task) {
  std::vector<std::string> files;
  for (const std::string& name : task.names) files.push_back(task.folder.empty() ? name : task.folder + "/" + name);
  for (const std::string& file : files)
    if (std::error_code error; std::filesystem::equivalent(file, task.to, error))
      return print_error("recordings export", sanitize(task.to) + " is the recording itself; name another file");
  LongWork work("export");
  const std::string problem = export_files(task, files, [&work](double share) { return work.advance(share); });
  work.clear();
  if (!problem.empty()) return print_error("recordings export", problem);
  io::print_formatted(stderr, "%s is complete\n", sanitize(task.to).c_str());
  return io::kExitDone;
}

}  // namespace tandem::server
