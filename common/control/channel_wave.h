#pragma once

#include "common/control/channel_energy_bounded.h"

namespace tandem::control {

/// Wave variables [Niemeyer & Slotine, IJRR 23(9) 2004] at both ends of the channel, with impedance b. With the motion
/// dr of the reference in one step T and the force F = k (r - x) at its end, a wave is written as a motion:
///
///     dy_in  = dr + F T / b       arrives, and decides dr
///     dy_out = dr - F T / b       leaves: sent as the velocity dy_out / T
///
///     F dr = b / (4 T) (dy_in^2 - dy_out^2)
///
/// The last line is an identity, so the channel gives the energy of the waves that arrive and takes that of the waves
/// that leave. The ledger books exactly these energies. A delay only stores waves. Loss, jitter and duplicates would
/// repeat waves: a wave acts only as far as energy that has arrived pays for it [after Yokokohji, Tsujioka, Yoshikawa,
/// ICRA 2002].
///
/// Waves carry no position. The usual correction moves the reference towards that of the other end at v_app at most,
/// paid as any other move. The two springs are in series: each end follows the reference of the other, not its
/// position.
class WaveEnd final : public EnergyBoundedEnd {
 public:
  using EnergyBoundedEnd::EnergyBoundedEnd;
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  void replace_velocity(AxisArray& v) const noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {.ledger = true}; }

 private:
  AxisArray out_{};  ///< dy_out / T of the last step [m/s or rad/s]
};

}  // namespace tandem::control
