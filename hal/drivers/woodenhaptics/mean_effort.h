#pragma once

#include <algorithm>

#include "hal/core/device.h"

namespace tandem::hal::woodenhaptics {

/// Mean of the joint efforts that acted since the last reading, weighted by their durations. Real-time safe.
class MeanEffort {
 public:
  /// Restarts without any effort. @param now  start of the first duration
  void restart(Time now) noexcept {
    sum_ = Vec3::Zero();
    duration_ = 0;
    until_ = now;
  }
  /// Adds `effort` [N m], which acted from the end of the previous one until `until`.
  void add(const Vec3& effort, Time until) noexcept {
    const double dt = std::max(0.0, seconds(until - until_));
    sum_ += dt * effort;
    duration_ += dt;
    until_ = until;
  }
  /// Returns the mean since the last call, `present` if no time has passed, and starts the next mean.
  [[nodiscard]] Vec3 take(const Vec3& present) noexcept {
    const Vec3 mean = duration_ > 0 ? Vec3(sum_ / duration_) : present;
    sum_ = Vec3::Zero();
    duration_ = 0;
    return mean;
  }

 private:
  Vec3 sum_ = Vec3::Zero();  ///< effort times time [N m s]
  double duration_ = 0;      ///< [s]
  Time until_{};
};

}  // namespace tandem::hal::woodenhaptics
