#pragma once

#include <cstddef>
#include <expected>
#include <optional>
#include <span>
#include <string>

#include "proto/spec/lesson.h"

namespace tandem {

/// Reads a recording. Any bytes are safe. A cut or damaged file gives what is whole: then `Lesson::complete` is false,
/// and ticks of damaged chunks are gaps.
/// @param bytes    of the whole MCAP file; they may be mapped
/// @param without  seats whose columns stay empty, to save memory
/// @return the lesson, or why this is no recording of this project: another kind of file, another format, a scene that
/// is not valid. The text names neither the file nor a next step; the caller does.
/// @throws std::bad_alloc  a row takes about 0.4 kB per seat and tool; a file has at most one row per 16 bytes
[[nodiscard]] std::expected<Lesson, std::string> read_lesson(std::span<const std::byte> bytes,
                                                             const LessonSeatSet& without = {});

/// Reads the files of a long session into one lesson, one after the other, each as `read_lesson` does.
class LessonReader {
 public:
  /// @param without  as for `read_lesson`
  explicit LessonReader(const LessonSeatSet& without = {}) : without_(without) {}
  /// Adds the next file. @return why it is no recording, or none that continues the files before; it is left out then
  [[nodiscard]] std::expected<void, std::string> add(std::span<const std::byte> bytes);
  /// Returns the lesson. @pre a file was added
  [[nodiscard]] Lesson take() { return std::move(*lesson_); }

 private:
  LessonSeatSet without_;
  std::optional<Lesson> lesson_;
};

}  // namespace tandem
