#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "common/base/format.h"

namespace tandem {

/// Date YYYY-MM-DD of a time in seconds since 1970, UTC, by the proleptic Gregorian calendar. Source: Howard Hinnant,
/// "chrono-Compatible Low-Level Date Algorithms", civil_from_days.
[[nodiscard]] inline std::string utc_date(std::int64_t at) {
  const std::chrono::year_month_day day{
      std::chrono::sys_days{std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds{std::chrono::seconds(at)})}};
  return format("%04d-%02u-%02u", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                static_cast<unsigned>(day.day()));
}

}  // namespace tandem
