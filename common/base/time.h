#pragma once

#include <chrono>
#include <cstdint>
#include <ratio>

namespace tandem {

/// A clock without `now()`: the caller passes the time to the cores. The same core therefore runs in real time (the
/// caller reads a monotonic clock) and in virtual time (the simulator counts ticks).
struct Clock {
  using rep = std::int64_t;                           ///< count of a duration
  using period = std::nano;                           ///< unit of a count
  using duration = std::chrono::nanoseconds;          ///< difference of two times
  using time_point = std::chrono::time_point<Clock>;  ///< point in time
  static constexpr bool is_steady = true;             ///< time never goes back
};

/// Difference of two times, in whole nanoseconds.
using Duration = Clock::duration;
/// Point in time of the caller's clock.
using Time = Clock::time_point;

/// Converts to seconds as double, for laws and reports; exact to the nanosecond up to 2^53 ns (104 days).
[[nodiscard]] constexpr double seconds(Duration d) noexcept { return std::chrono::duration<double>(d).count(); }

/// Returns the time since the start of the caller's clock in seconds.
[[nodiscard]] constexpr double seconds(Time t) noexcept { return seconds(t.time_since_epoch()); }

/// Returns the nanosecond nearest to `s` seconds. Valid for |s| < 9e9.
[[nodiscard]] constexpr Duration from_seconds(double s) noexcept {
  return Duration{static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))};
}

}  // namespace tandem
