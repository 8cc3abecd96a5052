#pragma once

#include <algorithm>

#include "common/base/token_bucket.h"

namespace tandem::server {

/// Limit of the datagrams of one client: a mean rate and a burst of at most `kBurst`. It counts only datagrams
/// that opened under the client's keys. A sender that merely knows the connection id cannot use up the rate.
class RateLimit {
 public:
  static constexpr int kBurst = 64;
  static constexpr Duration kWarnAfter = std::chrono::seconds(2);

  /// @param tick  nominal interval between two datagrams; 25 % more are allowed (1250/s at 1 kHz)
  explicit RateLimit(Duration tick) noexcept : bucket_(each(tick), each(tick) * kBurst - Duration{1}) {}

  [[nodiscard]] bool allow(Time now) noexcept {
    if (bucket_.take(now)) return true;
    if (now - last_excess_ > kQuiet) {
      excess_since_ = now;
      warned_ = false;
    }
    last_excess_ = now;
    return false;
  }
  /// True once per flood that has lasted for `kWarnAfter`.
  [[nodiscard]] bool poll_warning() noexcept {
    if (warned_ || last_excess_ - excess_since_ < kWarnAfter) return false;
    return warned_ = true;
  }

 private:
  static constexpr Duration kQuiet = std::chrono::milliseconds(200);
  static constexpr Duration each(Duration tick) noexcept { return std::max(Duration{1}, tick * 4 / 5); }

  TokenBucket bucket_;
  Time last_excess_ = Time{} - kQuiet - kQuiet, excess_since_{};
  bool warned_ = true;
};

}  // namespace tandem::server
