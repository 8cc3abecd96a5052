#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"

/// Consistency and gaps of a lesson, for every export. server/recording/lesson_record.h has its rows.
namespace tandem::server {

/// Returns why a lesson cannot be exported: no seat, no tool, no row, or a column whose length differs from the number
/// of rows; empty if it can.
[[nodiscard]] std::string lesson_problem(const Lesson& lesson);

/// Ticks of the session that have no row.
struct LessonGap {
  std::uint32_t first = 0;  ///< first missing session tick
  std::uint32_t ticks = 0;  ///< number of missing ticks, at least 1
  friend bool operator==(const LessonGap&, const LessonGap&) = default;
};

/// Returns the gaps between the first and the last row, in ascending order.
[[nodiscard]] std::vector<LessonGap> gaps_of(const Lesson& lesson);

/// Returns the number of joints of the scene's devices: 1 for LINEAR, otherwise 3. @pre a scene with a seat
[[nodiscard]] std::size_t joints_of(const SceneSpec& scene);

}  // namespace tandem::server
