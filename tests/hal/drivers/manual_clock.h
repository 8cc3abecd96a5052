#pragma once

#include <chrono>

#include "hal/core/clock.h"
#include "hal/core/driver.h"

namespace tandem::hal {

struct ManualClock final : Clock {
  Time at = Time{} + std::chrono::hours(1);
  Time now() noexcept override { return at; }
  void wait_until(Time until) noexcept override { at = std::max(at, until); }
};

struct Patient final : BringUp {
  void progress(std::string_view, double) override {}
  [[nodiscard]] bool cancelled() const noexcept override { return false; }
};

}  // namespace tandem::hal
