#pragma once

#include <ctime>

#include "common/base/time.h"

namespace tandem::hal {

/// Returns CLOCK_MONOTONIC as the time type of the drivers.
[[nodiscard]] inline Time monotonic_now() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{std::chrono::seconds(t.tv_sec) + Duration{t.tv_nsec}};
}

}  // namespace tandem::hal
