#pragma once

#include <cmath>

#include "common/control/channel.h"

namespace tandem::control {

/// An end that changes its spring only as far as its ledger pays, per axis:
///
///     dE = 1/2 k [(r' - x)^2 - (r - x)^2]        exact change of spring energy by the move r -> r'
///     dE < 0: the end moves; the channel absorbs -dE here
///     dE > 0: the end moves while dE <= E_0 + E_in received + eta D - E_out, else to the largest affordable |r' - x|
///
/// A change of k charges or credits 1/2 (k' - k)(r - x)^2 in the same way.
class EnergyBoundedEnd : public ChannelEnd {
 public:
  /// Starts as ChannelEnd does. @param params  parameters of this end
  explicit EnergyBoundedEnd(const ChannelParams& params);
  void clamp_reference(const AxisArray& x) noexcept TANDEM_REALTIME override;

 protected:
  /// Sets the stiffness of an axis if the ledger pays, else keeps it.
  /// @param axis    axis of the port, below dof()
  /// @param k       wanted stiffness [N/m or N m/rad]
  /// @param x       near end of the spring
  /// @param weight  number of springs
  void change_stiffness(std::size_t axis, double k, double x, double weight) noexcept {
    const double e = state_.ref[axis] - x;
    const double half_square = 0.5 * weight * e * e;
    const double dE = (k - state_.k[axis]) * half_square;
    if (dE <= 0) {
      state_.absorbed[axis] -= dE;
    } else if (ledger_[axis].spend(dE)) {
      state_.paid[axis] += dE;
    } else {
      return;  // not affordable now: k stays, and rises later
    }
    state_.k[axis] = k;
  }
  /// Moves the reference of an axis towards `wanted` as far as the ledger pays. Ignores values that are not finite.
  void move_reference(std::size_t axis, double wanted, double x, double weight) noexcept {
    const double stiffness = 0.5 * state_.k[axis] * weight;
    const double before = state_.ref[axis] - x;
    const double after = wanted - x;
    const double dE = stiffness * (after * after - before * before);
    if (!std::isfinite(dE)) return;  // a position that is not finite, or whose square overflows
    if (dE <= 0) {
      state_.absorbed[axis] -= dE;
    } else if (ledger_[axis].spend(dE)) {
      state_.paid[axis] += dE;
    } else {
      return move_affordable_part(axis, wanted, x, stiffness);
    }
    state_.ref[axis] = wanted;
  }

 private:
  /// Moves the reference of an axis to the largest elongation that the whole margin pays.
  void move_affordable_part(std::size_t axis, double wanted, double x, double half_stiffness) noexcept;

 protected:
  AxisArray approach_{};    ///< v_app in the units of each axis
  AxisArray effort_max_{};  ///< effort_max in the units of each axis
};

}  // namespace tandem::control
