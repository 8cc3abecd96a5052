#pragma once

#include <algorithm>
#include <cstddef>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::control {

/// Ramps an effort to zero within 100 ms. Per axis of the port [N or N m].
class ReleaseRamp {
 public:
  static constexpr Duration kTime = std::chrono::milliseconds(100);

  /// @param since   start of the ramp; earlier than now if a silence was noticed late
  /// @param effort  that the motor holds now
  void begin(Time since, const AxisArray& effort) noexcept {
    since_ = since;
    effort_ = effort;
  }
  /// Returns the share of the effort that is left, [0, 1].
  [[nodiscard]] double left(Time now) const noexcept {
    return std::max(0.0, 1.0 - seconds(now - since_) / seconds(kTime));
  }
  /// Returns the effort when the ramp began.
  [[nodiscard]] double from(std::size_t axis) const noexcept { return effort_[axis]; }

 private:
  Time since_{};
  AxisArray effort_{};
};

}  // namespace tandem::control
