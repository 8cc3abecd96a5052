#pragma once

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "hal/clock.h"
#include "hal/device.h"

namespace tandem::hal {

/// The machine's clock, CLOCK_MONOTONIC.
class MonotonicClock final : public Clock {
 public:
  [[nodiscard]] Time now() noexcept override;
  void wait_until(Time at) noexcept override;
};

/// Asks for SCHED_FIFO and exact timers for this thread. @return whether the kernel granted it
bool ask_for_realtime() noexcept;

/// Wake-ups of a servo on an absolute schedule, and how well they were kept.
class ServoPace {
 public:
  explicit ServoPace(Duration period) noexcept : period_(period) {}

  struct WakeUp {
    Time due{};                ///< the moment this wake-up stands for
    std::uint64_t missed = 0;  ///< periods that were slept through: never made up for in a burst
  };
  void begin() noexcept;
  /// Sleeps until the next period.
  WakeUp next() noexcept;
  /// Adds what was seen to `stats`: ticks are the caller's.
  void report(DeviceStats& stats) const noexcept;
  [[nodiscard]] const Histogram& periods() const noexcept { return periods_; }

 private:
  Duration period_;
  Time due_{}, last_{};
  std::uint64_t late_ = 0, missed_ = 0;
  Histogram periods_;
};

}  // namespace tandem::hal
