#pragma once

#include <ctime>

#include "common/base/time.h"

/// The clocks of this machine, for I/O loops; cores receive the time as an argument.
namespace tandem::io {

[[nodiscard]] inline Duration read_clock(clockid_t clock) noexcept {
  timespec t{};
  clock_gettime(clock, &t);
  return std::chrono::seconds(t.tv_sec) + Duration{t.tv_nsec};
}

/// Returns CLOCK_MONOTONIC as the time type of the cores.
[[nodiscard]] inline Time monotonic_now() noexcept { return Time{read_clock(CLOCK_MONOTONIC)}; }

/// Returns CLOCK_BOOTTIME, which goes on while the machine is suspended: for leases that another machine counts too.
[[nodiscard]] inline Time boottime_now() noexcept { return Time{read_clock(CLOCK_BOOTTIME)}; }

/// Converts for system calls that wait; negative durations become 0.
[[nodiscard]] inline timespec to_timespec(Duration d) noexcept {
  if (d < Duration::zero()) d = Duration::zero();
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(d);
  timespec t{};
  t.tv_sec = whole.count();
  t.tv_nsec = (d - whole).count();
  return t;
}

}  // namespace tandem::io
