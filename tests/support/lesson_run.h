#pragma once

#include <cstdint>
#include <string>

#include "proto/spec/lesson.h"
#include "server/report/tick_record.h"

namespace tandem::test {

/// A lesson without rows, with the seats and tools of a scene.
[[nodiscard]] Lesson empty_lesson(const SceneSpec& scene);
/// Appends the values of a tick.
void append_record(Lesson& lesson, const server::TickRecord& record);

/// A session in virtual time: the lesson, and the rows that `--trace` writes of it.
struct LessonRun {
  Lesson lesson;
  std::string trace;
};
/// Runs a shipped scene for `duration_s` of session time.
[[nodiscard]] LessonRun lesson_of(const std::string& scene, double duration_s, std::uint64_t seed = 1);

}  // namespace tandem::test
