#pragma once

#include <string>

#include "proto/recording/lesson_source.h"
#include "server/export/io/pending_path.h"

namespace tandem::server {

/// Writes the ticks of a lesson in which the session clock advanced as CSV, with the columns and the bytes of `--trace`
/// of the same session.
/// @pre lesson_problem(lesson).empty()
/// @return the error, empty if the file is complete
[[nodiscard]] std::string export_csv(LessonSource& lesson, const std::string& file, const ExportProgress& progress);

}  // namespace tandem::server
