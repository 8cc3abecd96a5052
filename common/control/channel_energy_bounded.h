#pragma once

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
  void change_stiffness(std::size_t axis, double k, double x, double weight) noexcept;
  /// Moves the reference of an axis towards `wanted` as far as the ledger pays. Ignores values that are not finite.
  void move_reference(std::size_t axis, double wanted, double x, double weight) noexcept;

  AxisArray approach_{};    ///< v_app in the units of each axis
  AxisArray effort_max_{};  ///< effort_max in the units of each axis
};

}  // namespace tandem::control
