#pragma once

#include <algorithm>

#include "common/base/time.h"

namespace tandem {

/// Token bucket: allows `rate` events per second, and up to `burst` at once after a pause. Starts full. It stores the
/// time at which the next event is due at that rate, and allows events that come at most a tolerance earlier.
/// Source: virtual scheduling form of the generic cell rate algorithm, ITU-T I.371, Annex A.
class TokenBucket {
 public:
  /// @param rate   [1/s], positive
  /// @param burst  at least 1
  constexpr TokenBucket(double rate, double burst) noexcept
      : TokenBucket(Duration{static_cast<Duration::rep>(1e9 / rate)}, burst) {}
  /// @param each       time per event
  /// @param tolerance  how much earlier than due an event may come
  constexpr TokenBucket(Duration each, Duration tolerance) noexcept : each_(each), tolerance_(tolerance) {}

  [[nodiscard]] constexpr bool take(Time now) noexcept {
    due_ = std::max(due_, now);
    if (due_ - now > tolerance_) return false;
    due_ += each_;
    return true;
  }
  /// Returns the time until an event is allowed; zero: now.
  [[nodiscard]] constexpr Duration wait(Time now) const noexcept {
    return std::max(Duration::zero(), due_ - now - tolerance_);
  }

 private:
  // The time per event is rounded down and the tolerance is a multiple of it: `burst` events always fit at once.
  constexpr TokenBucket(Duration each, double burst) noexcept
      : TokenBucket(each, Duration{static_cast<Duration::rep>((burst - 1) * static_cast<double>(each.count()))}) {}

  Duration each_, tolerance_;
  Time due_{};
};

}  // namespace tandem
