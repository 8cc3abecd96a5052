#pragma once

#include "common/base/time.h"

namespace tandem::hal {

/// Clock of a driver, passed in by its owner: CLOCK_MONOTONIC in hal/io, virtual time in tests. In virtual time,
/// waiting advances the clock.
struct Clock {
  virtual ~Clock() = default;
  [[nodiscard]] virtual Time now() noexcept = 0;
  virtual void wait_until(Time at) noexcept = 0;
};

}  // namespace tandem::hal
