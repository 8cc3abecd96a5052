#pragma once

#include "proto/recording/tick_messages.h"
#include "proto/spec/lesson.h"

/// Rows of a lesson, built from the messages of a recording. For readers of recordings.
namespace tandem::rec {

/// Takes memory for `rows` rows in all columns but those of the seats `without`.
void reserve_rows(Lesson& lesson, std::size_t rows, const LessonSeatSet& without);
/// Appends a row with the values of the last one; in the first row numbers are NaN and counts 0. No sample is fresh.
/// Columns of the seats `without` get no row.
/// @pre lesson.seats and lesson.tools have the sizes of the scene
void append_row(Lesson& lesson, std::uint32_t tick, std::int64_t time_ns, const LessonSeatSet& without);
/// Appends the rows [first, first + count) of a lesson of the same scene.
void copy_rows(const Lesson& from, std::size_t first, std::size_t count, Lesson& to);
/// Removes the first `count` rows.
void erase_rows(Lesson& lesson, std::size_t count);
/// Set values of the last row; those of a seat without columns are ignored. @pre there is a row; `i` and `j` are
/// indices of the scene
void set_seat(Lesson& lesson, std::size_t i, const SeatSample& sample);
void set_tool(Lesson& lesson, std::size_t j, const ToolSample& sample);
void set_authority(Lesson& lesson, const AuthoritySample& sample);
void set_session(Lesson& lesson, const SessionSample& sample);

}  // namespace tandem::rec
