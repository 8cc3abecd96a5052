#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "proto/spec/lesson.h"

namespace tandem {

namespace mcap {
class Reader;
}

/// Reads a recording. Any bytes are safe. A cut or damaged file gives what is whole: then `Lesson::complete` is false,
/// and ticks of damaged chunks are gaps.
/// @param bytes    of the whole MCAP file; they may be mapped
/// @param without  seats whose columns stay empty, to save memory
/// @return the lesson, or why this is no recording of this project: another kind of file, another format, a scene that
/// is not valid. The text names neither the file nor a next step; the caller does.
/// @throws std::bad_alloc  a row takes about 0.4 kB per seat and tool; a file has at most one row per 16 bytes
[[nodiscard]] std::expected<Lesson, std::string> read_lesson(std::span<const std::byte> bytes,
                                                             const LessonSeatSet& without = {});

/// Reads the files of a long session into one lesson, one after the other, each as `read_lesson` does. A file may be
/// added piece by piece, and its rows may be taken meanwhile, so that neither needs to be in memory as a whole.
class LessonReader {
 public:
  /// @param without  as for `read_lesson`
  explicit LessonReader(const LessonSeatSet& without = {});
  ~LessonReader();
  LessonReader(const LessonReader&) = delete;
  LessonReader& operator=(const LessonReader&) = delete;

  /// Adds the next file. @return why it is no recording, or none that continues the files before; it is left out then
  [[nodiscard]] std::expected<void, std::string> add(std::span<const std::byte> bytes);

  /// Begins the next file.
  /// @param definitions  the file without its messages
  /// @param file_bytes   size of the file, which bounds the number of its rows
  /// @return as for `add`
  [[nodiscard]] std::expected<void, std::string> begin_file(std::span<const std::byte> definitions,
                                                            std::uint64_t file_bytes);
  /// Adds messages of the file, in their order.
  /// @param piece  the file with some of its messages only
  void add_piece(std::span<const std::byte> piece);
  /// Ends the file. @param complete  it has an end and an account of its ticks
  void end_file(bool complete);

  /// Takes the rows that were added since the last call, as a lesson without notes, links and counts.
  /// @param last  with the last one, which further messages could still change. @pre a file was added or begun
  [[nodiscard]] Lesson take_rows(bool last);
  /// Returns the lesson, without the rows that were taken. @pre a file was added
  [[nodiscard]] Lesson take();

 private:
  class Builder;
  [[nodiscard]] std::expected<void, std::string> begin_file(const mcap::Reader& definitions, std::uint64_t file_bytes);
  void add_messages(const mcap::Reader& reader);

  LessonSeatSet without_;
  std::optional<Lesson> lesson_;
  std::unique_ptr<Builder> builder_;  ///< of the present file
  bool whole_ = true;                 ///< no message of it was damaged
  std::size_t taken_ = 0;             ///< rows of `lesson_` that were taken; later ones may compare with them
};

}  // namespace tandem
