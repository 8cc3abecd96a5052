#pragma once

#include "common/control/channel_energy_bounded.h"

/// Law `replica`: every client simulates the tool. A hand with sole authority therefore needs no feedback over the
/// network. The motion of the other hands reaches it as a reference whose every move is paid. The idea follows
/// client-side prediction in networked games and consensus of local copies [Huang & Lee, T-RO 29(2) 2013]. `ToolCopy`
/// documents the energy balance.
namespace tandem::control {

/// The client's end: the mix-minus reference r of the other hands. It is coupled to the copy of the tool by (1 - a) k_x
/// and by damping relative to the motion of r.
///
///     k_x = min(k_c, kappa / 2 d), kappa = 2 N s/m by default    where hands share authority
///     k_x = k_c                                       below a = 0.02, where no force is fed back
///
/// The first row is the P+d condition [Nuno et al., IJRR 28(7) 2009], halved as measurements required. Where the force
/// of a SLAVE seat's slave arrives through the server, its spring adds to (1 - a) k_x and its position to r.
class ReplicaReference final : public EnergyBoundedEnd {
 public:
  explicit ReplicaReference(const ChannelParams& params);
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  /// @param in  `x` is the position of the copy, `authority` that of this hand.
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {.ledger = true, .bounded_step = true}; }

  static constexpr double kFollows =
      0.02;  ///< below this authority the loop of a hand over the network is practically open
  /// While the other hands accelerate, the reference of a following hand may move this much faster than they do, in
  /// addition to v_app [m/s].
  static constexpr double kFollowerSpeedGain = 0.04;

 private:
  [[nodiscard]] double stiffness_for(double authority, double delay) const noexcept;

  double k_x_ = 0;      ///< slewed [N/m]
  AxisArray calm_v_{};  ///< filtered velocity of the other hands, which leads a following hand [m/s]
};

/// The server's end: the present position of the hand, predicted over the whole age of its newest sample. It pulls a
/// tool that sends no force back through this end, so nothing is paid. A new sample moves it to the better prediction
/// at a bounded speed, never by a step.
class PredictedHand final : public ChannelEnd {
 public:
  explicit PredictedHand(const ChannelParams& params);
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  void clamp_reference(const AxisArray& x) noexcept TANDEM_REALTIME override;
  /// @param in  `x` is the position of the tool.
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {.bounded_step = true}; }
};

}  // namespace tandem::control
