#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// Finds the gaps between the first and the last row of a lesson that comes piece by piece.
class GapFinder {
 public:
  /// @param rows  the next rows
  void add(const Lesson& rows);
  /// Returns the gaps so far, in ascending order.
  [[nodiscard]] const std::vector<LessonGap>& gaps() const noexcept { return gaps_; }

 private:
  std::vector<LessonGap> gaps_;
  std::optional<std::uint32_t> last_;  ///< tick of the last row
};

/// Returns the gaps of a lesson in memory.
[[nodiscard]] std::vector<LessonGap> gaps_of(const Lesson& lesson);

/// Returns the number of joints of the scene's devices: 1 for LINEAR, otherwise 3. @pre a scene with a seat
[[nodiscard]] std::size_t joints_of(const SceneSpec& scene);

}  // namespace tandem::server
