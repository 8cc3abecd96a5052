#pragma once

#include <algorithm>

#include "common/base/time.h"

namespace tandem::hal {

/// How long an exchange may wait for an answer without costing its servo a period: until the next exchange is due, by the
/// pace of those before. Clocks of a device and its host drift against each other; what comes later is there at the
/// beginning of the next exchange, while waiting for it would delay all that follow.
class ReplyPace {
 public:
  static constexpr Duration kPeriod = std::chrono::milliseconds(1);

  /// @param began  of this exchange; one that comes more than a period off the pace begins a new one
  /// @return when the next exchange is due
  Time next(Time began) noexcept {
    const bool in_pace = began >= due_ - kPeriod && began <= due_ + kPeriod;
    return due_ = (in_pace ? due_ : began) + kPeriod;
  }
  /// Nobody asked for an answer since more than `limit` after one was due: the program was stopped or starved.
  [[nodiscard]] bool stood_still(Time began, Duration limit) const noexcept { return due_ != Time{} && began - due_ > limit; }

 private:
  Time due_{};
};

}  // namespace tandem::hal
