#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

  /// Numbers per tick.
  [[nodiscard]] std::size_t width() const noexcept { return columns.empty() ? 1 : columns.size(); }
};

/// Returns the signals of a lesson, session first, then seats and tools. They refer to the lesson.
/// @pre lesson_problem(lesson).empty()
[[nodiscard]] std::vector<LessonSignal> signals_of(const Lesson& lesson);

}  // namespace tandem::server
