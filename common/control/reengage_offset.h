#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/base/axes.h"

namespace tandem::control {

/// Offset of a hand from the tool to which its springs are attached, per axis of the port [m or rad]. Hand and tool may
/// be apart when a seat engages, or engages again after an outage. The springs start without elongation about this
/// offset.
///
/// The offset stays until the gate has ramped in, because a hand that holds still must not be pulled by a growing
/// spring. It then decays at the approach speed. That speed is ramped up over 0.3 s, because a step would start with
/// 40 N/s. The owner takes each step of the decay, and pays for it where the law asks for that.
class ReengageOffset {
 public:
  static constexpr double kSpeedRamp = 0.3;  ///< time from rest to the approach speed [s]
  struct Params {
    std::size_t axes = 3;
    double hold = 0.5;   ///< time from engaging until the offset decays [s]: the ramp of the gate
    double v_app = 0.1;  ///< approach speed at the tip [m/s]
    double dt = 0.001;   ///< duration of a tick [s]
    AxisArray root_scale{1, 1, 1, 1, 1, 1, 1};  ///< square root of tip gain to port gain
  };
  ReengageOffset() noexcept : ReengageOffset(Params{}) {}
  explicit ReengageOffset(const Params& params) noexcept : p_(params) {}

  [[nodiscard]] double operator[](std::size_t axis) const noexcept { return offset_[axis]; }
  [[nodiscard]] const AxisArray& all() const noexcept { return offset_; }
  /// Change by the last `move` of each axis; 0 after `set`.
  [[nodiscard]] const AxisArray& last_step() const noexcept { return step_; }
  /// Sets the offset of an axis, for a seat that is not engaged.
  void set(std::size_t axis, double offset) noexcept {
    offset_[axis] = offset;
    step_[axis] = 0;
  }
  /// @param engaged_for  time since the seat engaged [s]
  /// @return whether the offset stays as it is
  [[nodiscard]] bool stays(double engaged_for) const noexcept { return engaged_for < p_.hold; }
  /// @return share of the approach speed with which the offset decays now, [0, 1]
  [[nodiscard]] double pace(double engaged_for) const noexcept {
    return std::clamp((engaged_for - p_.hold) / kSpeedRamp, 0.0, 1.0);
  }
  /// Returns the step of this tick towards 0.
  [[nodiscard]] double decay(std::size_t axis, double pace) const noexcept {
    const double most = pace * p_.v_app / p_.root_scale[axis] * p_.dt;
    return -std::clamp(offset_[axis], -most, most);
  }
  void move(std::size_t axis, double step) noexcept {
    step_[axis] = step;
    offset_[axis] += step;
  }
  /// Moves into the offset what exceeds `reach` of an elongation of the spring, tool minus hand.
  void absorb(const AxisArray& elongation, double reach) noexcept {
    double square = 0;
    for (std::size_t a = 0; a < p_.axes; ++a) square += elongation[a] * elongation[a];
    if (!(square > reach * reach)) return;
    const double beyond = 1 - reach / std::sqrt(square);
    for (std::size_t a = 0; a < p_.axes; ++a) offset_[a] -= beyond * elongation[a];
  }

 private:
  Params p_;
  AxisArray offset_{}, step_{};
};

}  // namespace tandem::control
