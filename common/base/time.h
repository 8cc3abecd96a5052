#pragma once

#include <chrono>
#include <cstdint>
#include <ratio>

namespace tandem {

/// A clock without `now()`: cores are told the time, they never ask for it. The same core therefore runs live
/// (the pump reads a monotonic clock) and in virtual time (the simulator counts ticks).
struct Clock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<Clock>;
  static constexpr bool is_steady = true;
};

using Duration = Clock::duration;
using Time = Clock::time_point;

/// Seconds as double, for laws and reports; 2^53 ns are 104 days, beyond that the last digits round.
[[nodiscard]] constexpr double seconds(Duration d) noexcept { return std::chrono::duration<double>(d).count(); }

/// The nearest nanosecond to `s` seconds. Valid for |s| < 9e9.
[[nodiscard]] constexpr Duration from_seconds(double s) noexcept {
  return Duration{static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))};
}

}  // namespace tandem
