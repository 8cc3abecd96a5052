#pragma once

#include "common/base/time.h"

namespace tandem::hal {

/// The time a driver lives in, handed to it: the machine's in io/, a virtual one in tests, where waiting moves it.
struct Clock {
  virtual ~Clock() = default;
  [[nodiscard]] virtual Time now() noexcept = 0;
  virtual void wait_until(Time at) noexcept = 0;
};

}  // namespace tandem::hal
