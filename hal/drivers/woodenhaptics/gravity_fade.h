#pragma once

#include <algorithm>
#include <optional>

#include "common/base/time.h"

namespace tandem::hal::woodenhaptics {

/// Share of gravity that the motors compensate, 0..1. Commands without effort get no current, so the compensation fades
/// in with commands that have effort, and out 100 ms after the last one.
class GravityFade {
 public:
  static constexpr double kIn = 2.0, kOut = 10.0;  ///< [1/s]
  static constexpr Duration kHold = std::chrono::milliseconds{100};

  /// @param effort_commanded  the present command has an effort  @param dt  time since the previous command
  /// @return the share
  double update(Time now, bool effort_commanded, Duration dt) noexcept {
    if (effort_commanded) effort_at_ = now;
    const bool hold = effort_at_ && now - *effort_at_ <= kHold;
    share_ = std::clamp(share_ + std::clamp(seconds(dt), 0.0, 0.01) * (hold ? kIn : -kOut), 0.0, 1.0);
    return share_;
  }
  /// The motors get no current.
  void release() noexcept { share_ = 0; }
  /// The motors get no current, and no effort counts as commanded before.
  void restart() noexcept { *this = {}; }

 private:
  double share_ = 0;
  std::optional<Time> effort_at_;  ///< time of the last command with an effort
};

}  // namespace tandem::hal::woodenhaptics
