#pragma once

#include "common/control/channel.h"

namespace tandem::control {

/// Set-position modulation with an energy ledger (design notes, control 4; in the spirit of [Lee & Huang, T-RO 26(2) 2010]). A received
/// position is a target; the reference moves as far towards it as the ledger pays, per axis:
///
///     dE = 1/2 k [(r' - x)^2 - (r - x)^2]        exact spring energy of the move r -> r'
///     dE < 0: move; the channel took -dE in here
///     dE > 0: move while dE <= E_0 + E_in received + eta D - E_out, else to the largest |r' - x| that is paid for
///
/// The reference never stays farther from x than the strongest motor's force over k: it gives way to a hand that pushes harder.
/// A change of k moves 1/2 (k' - k)(r - x)^2 through the ledger in the same way.
class SetPositionEnd final : public ChannelEnd {
 public:
  explicit SetPositionEnd(const ChannelParams& params);
  void give_way(const AxisArray& x) noexcept TANDEM_REALTIME override;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Promises promises() const noexcept override { return {.ledger = true, .bounded_step = true}; }

 private:
  void change_stiffness(std::size_t axis, double k, double x, double weight) noexcept;
  void move_reference(std::size_t axis, double wanted, double x, double weight) noexcept;

  AxisArray approach_{};   ///< v_app in the units of each axis
  AxisArray strongest_{};  ///< effort_max in the units of each axis
};

}  // namespace tandem::control
