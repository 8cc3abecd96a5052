#pragma once

#include "proto/spec/lesson.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Fills the record of one tick from a recorded lesson: every value is that which was recorded, bit for bit.
/// @pre row < lesson.rows()
void fill_record(const Lesson& lesson, std::size_t row, TickRecord& record) noexcept;

}  // namespace tandem::server
