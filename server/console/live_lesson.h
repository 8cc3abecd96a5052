#pragma once

#include <cstddef>
#include <cstdint>

#include "proto/spec/lesson.h"
#include "server/console/session_picture.h"

namespace tandem::console {

/// The values of a running session at the rate of TELEMETRY as a lesson, for scores while it runs. Columns that
/// telemetry has not stay empty. Its ticks are periods of telemetry, so that a lost datagram is a missing tick.
/// Bounded: the oldest rows end when kRowsMax or kBytesMax is reached.
class LiveLesson {
 public:
  static constexpr std::size_t kRowsMax = std::size_t{30} * 60 * 60;  ///< 30 minutes at 60 Hz
  static constexpr std::size_t kBytesMax = 32u << 20;                 ///< of the columns

  /// @param scene  of the session
  explicit LiveLesson(const SceneSpec& scene);

  /// Adds a picture of this session with live values. A picture of a period that is known adds nothing; one from before
  /// it begins the lesson again, because the session did.
  void add(const LivePicture& picture);
  [[nodiscard]] const Lesson& lesson() const noexcept { return lesson_; }

 private:
  void clear();
  void drop_oldest(std::size_t rows);

  std::uint32_t period_;  ///< [ticks]
  std::size_t rows_max_;
  std::uint64_t stops_ = 0;
  Lesson lesson_;
};

}  // namespace tandem::console
