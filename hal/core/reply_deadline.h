#pragma once

#include <algorithm>

#include "common/base/time.h"

namespace tandem::hal {

/// Deadline of a reply: the time when the next exchange is due, extrapolated from the schedule of the previous
/// exchanges.
/// Device and host clocks drift. A reply after the deadline is read at the start of the next exchange; waiting for it
/// would delay all later exchanges.
class ReplyDeadline {
 public:
  static constexpr Duration kPeriod = std::chrono::milliseconds(1);

  /// @param began  start of this exchange; more than a period off the schedule starts a new schedule
  /// @return when the next exchange is due
  Time next(Time began) noexcept {
    const bool in_pace = began >= due_ - kPeriod && began <= due_ + kPeriod;
    return due_ = (in_pace ? due_ : began) + kPeriod;
  }
  /// Returns whether `began` is more than `limit` after a reply was due: the program was stopped or starved.
  [[nodiscard]] bool stalled(Time began, Duration limit) const noexcept {
    return due_ != Time{} && began - due_ > limit;
  }

 private:
  Time due_{};
};

}  // namespace tandem::hal
