#pragma once

#include "common/control/channel.h"

namespace tandem::control {

/// An end whose spring is changed only as far as its ledger pays, per axis:
///
///     dE = 1/2 k [(r' - x)^2 - (r - x)^2]        exact spring energy of the move r -> r'
///     dE < 0: move; the channel took -dE in here
///     dE > 0: move while dE <= E_0 + E_in received + eta D - E_out, else to the largest |r' - x| that is paid for
///
/// A change of k moves 1/2 (k' - k)(r - x)^2 through the ledger in the same way.
class PaidEnd : public ChannelEnd {
 public:
  explicit PaidEnd(const ChannelParams& params);
  void give_way(const AxisArray& x) noexcept TANDEM_REALTIME override;

 protected:
  void change_stiffness(std::size_t axis, double k, double x, double weight) noexcept;
  void move_reference(std::size_t axis, double wanted, double x, double weight) noexcept;

  AxisArray approach_{};   ///< v_app in the units of each axis
  AxisArray strongest_{};  ///< effort_max in the units of each axis
};

}  // namespace tandem::control
