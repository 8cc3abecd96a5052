#pragma once

#include "proto/spec/lesson.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Fills the record of one tick from a recorded lesson: every value is that which was recorded, bit for bit.
/// @pre row < lesson.rows()
void fill_record(const Lesson& lesson, std::size_t row, TickRecord& record) noexcept;
/// The same for one seat. @pre seat < lesson.seats.size() and row < lesson.rows()
[[nodiscard]] SeatRecord seat_record(const Lesson& lesson, std::size_t seat, std::size_t row) noexcept;

}  // namespace tandem::server
