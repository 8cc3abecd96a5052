#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <utility>

#include "proto/spec/lesson.h"

namespace tandem {

/// Rows of a whole lesson.
struct LessonExtent {
  std::size_t rows = 0;
  std::uint32_t first_tick = 0, last_tick = 0;  ///< session ticks of the first and last row
  friend bool operator==(const LessonExtent&, const LessonExtent&) = default;
};

/// Returns the rows of a lesson in memory.
[[nodiscard]] inline LessonExtent extent_of(const Lesson& lesson) {
  return lesson.rows() == 0 ? LessonExtent{} : LessonExtent{lesson.rows(), lesson.tick.front(), lesson.tick.back()};
}

/// A lesson whose rows come piece by piece, so that hours of it need no more memory than minutes.
class LessonSource {
 public:
  LessonSource() = default;
  LessonSource(const LessonSource&) = delete;
  LessonSource& operator=(const LessonSource&) = delete;
  virtual ~LessonSource() = default;
  /// Returns scene, metadata, persons, notes, links and counts of the whole lesson. Its columns are not to be read.
  [[nodiscard]] virtual const Lesson& head() const = 0;
  [[nodiscard]] virtual LessonExtent extent() const = 0;
  /// Returns the next rows as a lesson with the scene of the head, valid until the next call; null: there is none.
  /// @return error: why the rows cannot be read, with the name of the file
  [[nodiscard]] virtual std::expected<const Lesson*, std::string> next() = 0;
};

/// A lesson in memory as one piece.
class WholeLesson final : public LessonSource {
 public:
  /// @param lesson  outlives this
  explicit WholeLesson(const Lesson& lesson) : lesson_(&lesson), next_(&lesson) {}
  [[nodiscard]] const Lesson& head() const override { return *lesson_; }
  [[nodiscard]] LessonExtent extent() const override { return extent_of(*lesson_); }
  [[nodiscard]] std::expected<const Lesson*, std::string> next() override { return std::exchange(next_, nullptr); }

 private:
  const Lesson *lesson_, *next_;
};

}  // namespace tandem
