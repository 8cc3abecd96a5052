#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

#include "common/base/histogram.h"
#include "common/base/time.h"

namespace tandem::client {

/// Punctuality of the ticks of this client, and steps of its wall clock. No heap after construction.
class TickStatistics {
 public:
  static constexpr Duration kLate = std::chrono::milliseconds(1);

  /// Records one tick.
  /// @param late         lateness of this tick  @param missed  ticks skipped before it
  /// @param wall_offset  wall clock minus monotonic clock
  void add(Duration late, std::uint32_t missed, Duration wall_offset) noexcept {
    ++ticks_;
    late_ticks_ += late > kLate ? 1 : 0;
    missed_ticks_ += missed;
    lateness_.add(late.count());
    if (wall_offset_) {
      const Duration step = wall_offset - *wall_offset_;
      if (std::abs(step.count()) > std::abs(clock_step_.count())) clock_step_ = step;
    }
    wall_offset_ = wall_offset;
  }
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  [[nodiscard]] std::uint64_t late_ticks() const noexcept { return late_ticks_; }  ///< by more than kLate
  [[nodiscard]] std::uint64_t missed_ticks() const noexcept { return missed_ticks_; }
  [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }  ///< [ns]
  /// Largest change of the wall clock relative to the monotonic clock from one tick to the next [s]; nullopt before the
  /// second tick.
  [[nodiscard]] std::optional<double> clock_step() const noexcept {
    return ticks_ > 1 ? std::optional{seconds(clock_step_)} : std::nullopt;
  }

 private:
  std::uint64_t ticks_ = 0, late_ticks_ = 0, missed_ticks_ = 0;
  Histogram lateness_;
  std::optional<Duration> wall_offset_;
  Duration clock_step_{};
};

}  // namespace tandem::client
