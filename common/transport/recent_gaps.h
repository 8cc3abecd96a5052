#pragma once

#include <algorithm>
#include <array>

#include "common/base/time.h"

namespace tandem::transport {

/// The longest gap between two datagrams in the last 50 to 60 s; shorter silences are normal on this link.
class RecentGaps {
 public:
  void add(Time now, Duration gap) noexcept {
    if (!any_) begin_ = now;
    any_ = true;
    if (now - begin_ >= kPart) {
      begin_ = now;
      full_ = std::min(full_ + 1, kParts);
      newest_ = (newest_ + 1) % kParts;
      longest_[newest_] = Duration{};
    }
    longest_[newest_] = std::max(longest_[newest_], gap);
  }
  /// Returns the tolerated silence: eight times the longest gap, within these bounds. On a link known for less than 50
  /// s it returns `most`, because its gaps are not known yet.
  [[nodiscard]] Duration silence_limit(Duration least, Duration most) const noexcept {
    if (full_ + 1 < kParts) return most;
    return std::max(std::min(least, most), std::min(most, kBorne * *std::ranges::max_element(longest_)));
  }

 private:
  static constexpr Duration kPart = std::chrono::seconds(10);
  static constexpr std::size_t kParts = 6;
  static constexpr int kBorne = 8;
  std::array<Duration, kParts> longest_{};
  std::size_t newest_ = 0, full_ = 0;
  Time begin_{};
  bool any_ = false;
};

}  // namespace tandem::transport
