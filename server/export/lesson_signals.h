#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"

/// The signals of a lesson with the names, units and frames under which exports write them.
namespace tandem::server {

/// One signal: a row of `columns.size()` numbers at each tick. Numbers are real, or whole if `whole` is set.
struct LessonSignal {
  std::string group;                 ///< `session`, `seats/NAME` or `tools/NAME`
  std::string name;                  ///< word of CRTK where one exists, such as `measured_cp`
  std::string unit;                  ///< SI; `1` for counts, flags and shares
  std::string frame;                 ///< frame of the numbers: `task`, `joint` or `none`
  std::string description;           ///< sentence for users
  std::vector<std::string> columns;  ///< names, such as x, y, z; empty: one number per tick
  std::function<void(std::size_t row, std::span<double>)> real;
  std::function<void(std::size_t row, std::span<std::int64_t>)> whole;

  // Range of the numbers that a file may have. Real numbers without a limit may be NaN: not known.
  double real_max = std::numeric_limits<double>::infinity();  ///< of the magnitude; finite: no NaN
  std::int64_t whole_min = std::numeric_limits<std::int64_t>::min();
  std::int64_t whole_max = std::numeric_limits<std::int64_t>::max();
  // Set by signals_to_read for signals that a lesson stores; the others follow from these.
  std::function<void(std::size_t rows)> resize;
  std::function<void(std::size_t row, std::span<const double>)> set_real;
  std::function<void(std::size_t row, std::span<const std::int64_t>)> set_whole;

  /// Numbers per tick.
  [[nodiscard]] std::size_t width() const noexcept { return columns.empty() ? 1 : columns.size(); }
};

/// Returns the signals of a lesson, session first, then seats and tools. They refer to the lesson.
/// @pre lesson_problem(lesson).empty()
[[nodiscard]] std::vector<LessonSignal> signals_of(const Lesson& lesson);
/// Returns the same signals, with which a reader of exports fills the columns of a lesson without rows.
/// @pre the scene is valid; `lesson.seats` and `lesson.tools` have its sizes
[[nodiscard]] std::vector<LessonSignal> signals_to_read(Lesson& lesson);

}  // namespace tandem::server
