#pragma once

#include <cstddef>

#include "common/base/axes.h"

namespace tandem::client {

/// The transformer between the hand of a seat and its tool, with scale s:
///
///     x_tool = s x_hand        v_tool = s v_hand        F_hand = s F_tool
///
/// It conserves power: F_hand v_hand = F_tool v_tool. Energies are therefore the same at both sides. A spring of
/// stiffness k at the hand is one of k / s^2 at the tool. Device, force gate and guards use values of the hand;
/// coupling, channel and datagrams use values of the tool. Arrays are in port axes. Real-time safe.
class MotionScale {
 public:
  /// @param scale  s, positive
  MotionScale(double scale, std::size_t dof) noexcept : scale_(scale), dof_(dof) {}

  [[nodiscard]] double value() const noexcept { return scale_; }
  /// Takes position and velocity of the hand.
  void update(const AxisArray& q, const AxisArray& v) noexcept TANDEM_REALTIME {
    for (std::size_t a = 0; a < dof_; ++a) {
      q_[a] = scale_ * q[a];
      v_[a] = scale_ * v[a];
    }
  }
  /// Position and velocity of the hand as the tool sees them.
  [[nodiscard]] const AxisArray& q() const noexcept { return q_; }
  [[nodiscard]] const AxisArray& v() const noexcept { return v_; }

  /// Returns the effort at the hand of an effort at the tool.
  [[nodiscard]] AxisArray effort_at_hand(const AxisArray& at_tool) const noexcept TANDEM_REALTIME {
    return multiplied(at_tool, scale_);
  }
  /// Returns the effort at the tool of an effort at the hand.
  [[nodiscard]] AxisArray effort_at_tool(const AxisArray& at_hand) const noexcept TANDEM_REALTIME {
    return multiplied(at_hand, 1 / scale_);
  }
  /// Returns the position of the hand that corresponds to a position of the tool.
  [[nodiscard]] AxisArray position_at_hand(const AxisArray& at_tool) const noexcept TANDEM_REALTIME {
    return multiplied(at_tool, 1 / scale_);
  }

 private:
  [[nodiscard]] AxisArray multiplied(AxisArray values, double factor) const noexcept {
    for (std::size_t a = 0; a < dof_; ++a) values[a] *= factor;
    return values;
  }

  double scale_;
  std::size_t dof_;
  AxisArray q_{}, v_{};
};

}  // namespace tandem::client
