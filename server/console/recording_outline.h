#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"
#include "server/console/seat_presence.h"

/// Outline of a recording: all that a page needs before it plays it.
namespace tandem::console {

/// Ticks [from, to) that the file has no row for.
struct RecordingGap {
  std::uint32_t from = 0, to = 0;
  [[nodiscard]] std::uint32_t ticks() const noexcept { return to - from; }
  friend bool operator==(const RecordingGap&, const RecordingGap&) = default;
};

/// Curves over the whole recording: points of equal distance in session time. NaN: no row, not known, or of a free
/// seat.
class RecordingCurves {
 public:
  static constexpr std::size_t kPointsMax = 6000;  ///< beyond it the distance doubles
  static constexpr double kStepHz = 10;            ///< first distance: 0.1 s

  RecordingCurves() = default;
  explicit RecordingCurves(const SceneSpec& scene);
  /// Adds row `row` of a lesson of this scene. @pre rows come in the order of their ticks
  void add(const Lesson& lesson, std::size_t row, const SeatPresence& presence);
  /// Ends the curves. A last step of which the file has less than a tenth gives no point: the tick with which a session
  /// ends has no authority, and is no value of that step.
  /// @param last  tick of the last row
  void finish(std::uint32_t last);

  [[nodiscard]] std::uint32_t step_ticks() const noexcept { return step_; }
  [[nodiscard]] std::size_t size() const noexcept { return points_.size() / (width_ == 0 ? 1 : width_); }
  /// Largest force on the hand of a seat in the step that begins at the point [N].
  [[nodiscard]] float seat_force(std::size_t point, std::size_t seat) const { return at(point, seat); }
  /// Largest force of the environment on a tool, likewise [N].
  [[nodiscard]] float tool_force(std::size_t point, std::size_t tool) const { return at(point, seats_ + tool); }
  /// Coordinate of a tool in a row of the first tenth of the step [m].
  [[nodiscard]] float tool_x(std::size_t point, std::size_t tool, std::size_t axis) const {
    return at(point, seats_ + tools_ + 3 * tool + axis);
  }
  /// Authority of a master over a tool in that row [0, 1].
  [[nodiscard]] float alpha(std::size_t point, std::size_t tool, std::size_t master) const {
    return at(point, seats_ + 4 * tools_ + masters_ * tool + master);
  }

 private:
  [[nodiscard]] float at(std::size_t point, std::size_t column) const { return points_[point * width_ + column]; }
  void halve();

  std::size_t seats_ = 0, tools_ = 0, masters_ = 0, width_ = 0;
  std::uint32_t step_ = 1, first_ = 0;
  std::vector<float> points_;  ///< `width_` values each
};

/// Outline of a recording, from its rows in order.
class RecordingOutline {
 public:
  static constexpr std::size_t kGapsMax = 1000, kNotesMax = 2000;

  RecordingOutline() = default;
  /// @param head  the lesson without rows: scene, session, persons
  explicit RecordingOutline(Lesson head);
  /// Adds the rows, events and marks of the next part of the file. Rows that are not after the last one are left out.
  /// @return whether all rows were
  bool add(const Lesson& part);
  /// Ends the outline: keeps the longest gaps, in the order of time.
  void finish(bool complete);

  [[nodiscard]] const Lesson& head() const noexcept { return head_; }
  [[nodiscard]] bool empty() const noexcept { return rows_ == 0; }
  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::uint32_t first() const noexcept { return first_; }  ///< tick
  [[nodiscard]] std::uint32_t last() const noexcept { return last_; }    ///< tick
  [[nodiscard]] bool complete() const noexcept { return complete_; }
  [[nodiscard]] std::uint64_t missing_ticks() const noexcept { return missing_; }
  [[nodiscard]] std::uint64_t gap_count() const noexcept { return gap_count_; }
  /// The longest gaps, at most kGapsMax.
  [[nodiscard]] const std::vector<RecordingGap>& gaps() const noexcept { return gaps_; }
  /// The first events and marks, at most kNotesMax of each.
  [[nodiscard]] const std::vector<LessonEvent>& events() const noexcept { return events_; }
  [[nodiscard]] const std::vector<LessonMark>& marks() const noexcept { return marks_; }
  [[nodiscard]] std::uint64_t notes_left_out() const noexcept { return left_out_; }
  [[nodiscard]] const RecordingCurves& curves() const noexcept { return curves_; }
  /// Seats that no participant had at any time.
  [[nodiscard]] LessonSeatSet seats_without_samples() const;
  /// Memory of the lesson without the columns of these seats [bytes], about.
  [[nodiscard]] std::uint64_t lesson_bytes() const;
  [[nodiscard]] double time(std::uint32_t tick) const noexcept { return tick / head_.scene.tick_hz; }  ///< [s]

 private:
  void keep_longest_gaps();

  Lesson head_;
  std::uint64_t rows_ = 0, missing_ = 0, gap_count_ = 0, left_out_ = 0;
  std::uint32_t first_ = 0, last_ = 0;
  bool complete_ = false;
  std::vector<RecordingGap> gaps_;
  std::vector<LessonEvent> events_;
  std::vector<LessonMark> marks_;
  SeatPresence presence_;
  RecordingCurves curves_;
};

}  // namespace tandem::console
