#pragma once

#include "common/control/channel_paid.h"

/// Law `replica`: every client simulates the tool, so of a hand that leads alone nothing travels; only what others do reaches a hand over
/// the network, as a reference whose every move is paid. In the spirit of client-side prediction in networked games and of
/// consensus of local copies [Huang & Lee, T-RO 29(2) 2013]; the energy balance stands at `ToolCopy`.
namespace tandem::control {

/// The client's end: the others' mix-minus reference r, tied to the copy of the tool by (1 - a) k_x and by damping relative to r's motion.
///
///     k_x = min(k_c, kappa / 2 d), kappa = 2 N s/m        where hands share: P+d [Nuno et al., IJRR 28(7) 2009] halved, found by measurement
///     k_x = k_c                                           below a = 0.02, where nothing is fed back
///
/// Where a slave of a SLAVE seat is felt by way of the server, its spring adds to (1 - a) k_x and its place to r.
class ReplicaReference final : public PaidEnd {
 public:
  explicit ReplicaReference(const ChannelParams& params);
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  /// `in.x` is the copy's position, `in.authority` this hand's.
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Promises promises() const noexcept override { return {.ledger = true, .bounded_step = true}; }

  static constexpr double kKappa = 2;       ///< [N s/m]
  static constexpr double kFollows = 0.02;  ///< authority below which a hand's loop over the network is as good as open
  /// A reference that leads a follower moves faster than the others while they accelerate, beside v_app [m/s].
  static constexpr double kGainsSpeed = 0.04;

 private:
  [[nodiscard]] double stiffness_for(double authority, double delay) const noexcept;

  double k_x_ = 0;      ///< slewed [N/m]
  AxisArray calm_v_{};  ///< the others' velocity by which a hand that follows is led [m/s]
};

/// The server's end: the hand as it is by now, predicted over the whole age of its newest sample. It pulls a tool that no hand hears by
/// way of this end, so nothing is paid. When news come it goes to the better prediction by and by, never by a step.
class PredictedHand final : public ChannelEnd {
 public:
  explicit PredictedHand(const ChannelParams& params);
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  void give_way(const AxisArray& x) noexcept TANDEM_REALTIME override;
  /// `in.x` is the tool's position.
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Promises promises() const noexcept override { return {.bounded_step = true}; }
};

}  // namespace tandem::control
