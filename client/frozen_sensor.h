#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::client {

/// A sensor that says the same although its hand is led elsewhere (design notes, security 2.4). A person can hold a handle so still that
/// not one count changes, so sameness alone proves nothing: the reference must have gone away by 5 mm and the motor's pull have
/// changed by more than friction hides, for 100 ms, without one bit of the reading moving. No grip is that stiff.
class FrozenSensor {
 public:
  static constexpr Duration kSuspectAfter = std::chrono::milliseconds(100);
  static constexpr double kExpectedMotion = 0.005;  ///< at the tip [m]
  static constexpr double kPullChange = 0.5;        ///< at the tip [N]

  /// @param q       the raw reading
  /// @param ref     where the hand is led, port axes  @param effort  of the motor now, port axes
  /// @param scale   tip gain to port gain, per axis  @param active  effort may reach the hand at all
  void look(Time now, const AxisArray& q, std::size_t joints, const AxisArray& ref, const AxisArray& effort, const AxisArray& scale,
            std::size_t dof, bool active) noexcept TANDEM_REALTIME {
    const bool same = std::equal(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(joints), q_.begin());
    if (!same) frozen_ = false;  // it moves: the next look begins anew
    if (!same || (!active && !frozen_)) {
      q_ = q;
      ref_ = ref;
      effort_ = effort;
      since_ = now;
      return;
    }
    if (frozen_ || now - since_ <= kSuspectAfter) return;
    double way = 0, pull = 0;
    for (std::size_t a = 0; a < dof; ++a) {
      way += (ref[a] - ref_[a]) * (ref[a] - ref_[a]) * scale[a];
      pull += (effort[a] - effort_[a]) * (effort[a] - effort_[a]) / scale[a];
    }
    frozen_ = way > kExpectedMotion * kExpectedMotion && pull > kPullChange * kPullChange;
  }
  /// Until the reading changes.
  [[nodiscard]] bool frozen() const noexcept { return frozen_; }

 private:
  AxisArray q_{}, ref_{}, effort_{};
  Time since_{};
  bool frozen_ = false;
};

}  // namespace tandem::client
