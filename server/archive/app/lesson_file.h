#pragma once

#include <expected>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"
#include "server/archive/recording_row.h"

namespace tandem::server {

/// Reads a recording. @return the lesson, or why it cannot be read, without the name of the file
/// @param without  seats whose columns stay empty, to save memory
[[nodiscard]] std::expected<Lesson, std::string> load_lesson(const std::string& path,
                                                             const LessonSeatSet& without = {});

/// Reads the files of a recording, in their order, as one lesson. @return the lesson, or why one of them cannot be
/// read; of several with the name of the file
[[nodiscard]] std::expected<Lesson, std::string> load_lesson(const std::vector<std::string>& files,
                                                             const LessonSeatSet& without = {});

/// Reads what the index keeps of a recording. @return the summary, or the error as above
[[nodiscard]] std::expected<RecordingSummary, std::string> load_summary(const std::string& path);

}  // namespace tandem::server
