#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/base/sanitize.h"
#include "common/io/print.h"
#include "common/io/usage_errors.h"
#include "server/app/commands/long_work.h"
#include "server/app/commands/recordings_actions.h"
#include "server/app/commands/state_option.h"
#include "server/archive/io/part_files.h"
#include "server/archive/io/recording_stream.h"
#include "server/archive/recording_row.h"
#include "server/export/app/csv_export.h"
#include "server/export/app/lerobot_export.h"
#include "server/export/io/hdf5_export.h"
#include "server/export/lesson_records.h"

namespace tandem::server {
namespace {

constexpr const char* kExport = "recordings export";
constexpr mode_t kOthersMask = 0027;  // permissions that an export does not get

using FileNames = std::vector<std::string>;  ///< of one recording, in their order

/// Finds the recordings of the named files. @return their files, or the error with its remedy
std::expected<std::vector<FileNames>, std::string> files_to_export(const RecordingsTask& task) {
  FileNames named;
  for (const std::string& name : task.names) named.push_back(task.folder.empty() ? name : task.folder + "/" + name);
  std::vector<FileNames> recordings;
  if (task.one_file) {
    for (std::string& file : named) recordings.push_back({std::move(file)});
    return recordings;
  }
  const auto found = find_recordings(named);
  if (!found)
    return std::unexpected(sanitize(found.error().text) +
                           (found.error().incomplete
                                ? ". To export the named files alone, each as a lesson, repeat with --one-file"
                                : ""));
  for (const std::vector<RecordedPart>& parts : *found) {
    FileNames& files = recordings.emplace_back();
    for (const RecordedPart& part : parts) files.push_back(part.file);
  }
  return recordings;
}

/// Opens a lesson that can be exported, and tells what is missing in it.
/// @return the lesson, or the error with the name of the file
std::expected<std::unique_ptr<LessonSource>, std::string> open_exportable(const FileNames& files, LongWork& work) {
  auto opened = RecordingStream::open(files, [&work](double share) { return work.advance(share); });
  if (!opened) return std::unexpected(sanitize(opened.error()));
  const std::string name = sanitize(files.front());
  const Lesson& head = (*opened)->head();
  if ((*opened)->extent().rows == 0) return std::unexpected(name + ": " + lesson_problem(head));
  work.clear();
  if (files.size() > 1)
    io::print_formatted(stderr, "%s: recording of %zu files, to %s\n", name.c_str(), files.size(),
                        sanitize(files.back()).c_str());
  if (const std::uint64_t missing = missing_ticks_of(head, (*opened)->extent()); missing > 0)
    io::print_formatted(stderr, "%s: %llu ticks are missing; the export has no rows for them\n", name.c_str(),
                        static_cast<unsigned long long>(missing));
  if (!head.complete) io::print_formatted(stderr, "%s: the end is missing, or a part is damaged\n", name.c_str());
  return std::move(*opened);
}

bool is_data_set(ExportFormat format) {
  return format == ExportFormat::kLerobot21 || format == ExportFormat::kLerobot30;
}

std::string export_lessons(const RecordingsTask& task, const std::vector<FileNames>& recordings, LongWork& reading,
                           LongWork& writing) {
  const ExportProgress progress = [&writing](double share) { return writing.advance(share); };
  if (is_data_set(task.format)) {
    LerobotRequest request;
    request.version = task.format == ExportFormat::kLerobot21 ? LerobotVersion::k21 : LerobotVersion::k30;
    request.fps = task.fps;
    request.task = task.task;
    request.episodes = recordings.size();
    request.lesson = [&](std::size_t episode) {
      writing.clear();
      return open_exportable(recordings[episode], reading);
    };
    return export_lerobot(request, task.to, progress);
  }
  const auto lesson = open_exportable(recordings.front(), reading);
  if (!lesson) return lesson.error();
  return (task.format == ExportFormat::kCsv ? export_csv : export_hdf5)(**lesson, task.to, progress);
}

}  // namespace

int export_recordings(const RecordingsTask& task) {
  const auto recordings = files_to_export(task);
  if (!recordings) return print_error(kExport, recordings.error());
  for (const FileNames& files : *recordings)
    for (const std::string& file : files)
      if (std::error_code error; std::filesystem::equivalent(file, task.to, error))
        return print_error(kExport, sanitize(task.to) + " is the recording itself; name another file");
  if (!is_data_set(task.format) && recordings->size() > 1)
    return print_usage_error(kExport, "NAME: csv and hdf5 take one recording, not " +
                                          std::to_string(recordings->size()) + ", such as " +
                                          sanitize((*recordings)[0][0]) + " and " + sanitize((*recordings)[1][0]));
  // An export has the personal data of its recording, so it gets no wider mode (0640): files of every format, and those
  // of the program that writes Parquet.
  ::umask(::umask(0) | kOthersMask);
  LongWork reading("reading"), writing("export");
  const std::string problem = export_lessons(task, *recordings, reading, writing);
  reading.clear();
  writing.clear();
  if (!problem.empty()) return print_error(kExport, problem);
  io::print_formatted(stderr, "%s is complete\n", sanitize(task.to).c_str());
  return io::kExitDone;
}

}  // namespace tandem::server
