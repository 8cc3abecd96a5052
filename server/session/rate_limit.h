#pragma once

#include <algorithm>

#include "common/base/time.h"

namespace tandem::server {

/// Token bucket for the datagrams of one client: a mean rate and a burst of at most `kBurst`. It counts only datagrams
/// that opened under the client's keys. A sender that merely knows the connection id cannot use up the rate.
class RateLimit {
 public:
  static constexpr int kBurst = 64;
  static constexpr Duration kWarnAfter = std::chrono::seconds(2);

  /// @param tick  nominal interval between two datagrams; 25 % more are allowed (1250/s at 1 kHz)
  explicit RateLimit(Duration tick) noexcept : each_(std::max(Duration{1}, tick * 4 / 5)) {}

  [[nodiscard]] bool allow(Time now) noexcept {
    due_ = std::max(due_, now);
    if (due_ - now < each_ * kBurst) {
      due_ += each_;
      return true;
    }
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
  Duration each_;
  Time due_{}, last_excess_ = Time{} - kQuiet - kQuiet, excess_since_{};
  bool warned_ = true;
};

}  // namespace tandem::server
