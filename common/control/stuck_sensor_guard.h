#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::control {

/// Detects a sensor whose reading is constant although the hand is being moved. A participant can hold a handle so
/// still that not one count changes, so a constant reading alone proves nothing. The sensor is stuck if for 100 ms not
/// one bit of the reading changes while two conditions hold. The reference has moved away by 5 mm, and the motor's pull
/// has changed by more than friction hides. No grip is that stiff.
class StuckSensorGuard {
 public:
  static constexpr Duration kSuspectAfter = std::chrono::milliseconds(100);
  static constexpr double kExpectedMotion = 0.005;  ///< at the tip [m]
  static constexpr double kPullChange = 0.5;        ///< at the tip [N]

  /// @param q       the raw reading
  /// @param ref     the reference of the hand, port axes  @param effort  present motor effort, port axes
  /// @param scale   tip gain to port gain, per axis  @param active  effort may reach the hand
  void update(Time now, const AxisArray& q, std::size_t joints, const AxisArray& ref, const AxisArray& effort,
              const AxisArray& scale, std::size_t dof, bool active) noexcept TANDEM_REALTIME {
    const bool same = std::equal(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(joints), q_.begin());
    if (!same) stuck_ = false;  // the sensor moves: restart the observation
    if (!same || (!active && !stuck_)) {
      q_ = q;
      ref_ = ref;
      effort_ = effort;
      since_ = now;
      return;
    }
    if (stuck_ || now - since_ <= kSuspectAfter) return;
    double way = 0, pull = 0;
    for (std::size_t a = 0; a < dof; ++a) {
      way += (ref[a] - ref_[a]) * (ref[a] - ref_[a]) * scale[a];
      pull += (effort[a] - effort_[a]) * (effort[a] - effort_[a]) / scale[a];
    }
    stuck_ = way > kExpectedMotion * kExpectedMotion && pull > kPullChange * kPullChange;
  }
  /// True until the reading changes.
  [[nodiscard]] bool stuck() const noexcept { return stuck_; }

 private:
  AxisArray q_{}, ref_{}, effort_{};
  Time since_{};
  bool stuck_ = false;
};

}  // namespace tandem::control
