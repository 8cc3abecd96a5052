#pragma once

#include "common/base/histogram.h"
#include "common/base/time.h"
#include "hal/core/clock.h"
#include "hal/core/device.h"

namespace tandem::hal {

/// Clock of the machine, CLOCK_MONOTONIC.
class MonotonicClock final : public Clock {
 public:
  [[nodiscard]] Time now() noexcept override;
  void wait_until(Time at) noexcept override;
};

/// Requests SCHED_FIFO and exact timers for the calling thread. @return whether the kernel granted SCHED_FIFO
bool request_realtime() noexcept;

/// Timer of a servo: wake-ups on an absolute schedule, with statistics of their lateness.
class PeriodicTimer {
 public:
  explicit PeriodicTimer(Duration period) noexcept : period_(period) {}

  struct WakeUp {
    Time due{};                ///< scheduled time of this wake-up
    std::uint64_t missed = 0;  ///< skipped periods; the timer does not make up for them in a burst
  };
  void begin() noexcept;
  /// Moves the next wake-up and all after it. @param by  negative: earlier; at most 1 % of the period counts
  void shift(Duration by) noexcept;
  /// Sleeps until the next period.
  WakeUp next() noexcept;
  /// Writes late, missed and period statistics to `stats`; the caller counts the ticks.
  void report(DeviceStats& stats) const noexcept;
  [[nodiscard]] const Histogram& periods() const noexcept { return periods_; }

 private:
  Duration period_;
  Time due_{}, last_{};
  std::uint64_t late_ = 0, missed_ = 0;
  Histogram periods_;
};

}  // namespace tandem::hal
