#pragma once

#include "common/control/channel_energy_bounded.h"

/// Two-port time-domain passivity approach: force down, position up [Ryu, Artigas, Preusche, Mechatronics 20(7) 2010].
/// Each end counts the energy that it takes from the channel and the energy that it gives. One end gives at most the
/// energy that the other end has taken, as far as it has heard of it, plus E_0.
namespace tandem::control {

/// The client's end: the hand feels the force that the tool's spring had at the server. The force F is that of a spring
/// k on the virtual mass, whose end is placed in every tick. With e = r - x before and dx the motion of the mass
/// in the implicit step,
///
///     work on the mass = k (e - dx) dx <= k e^2 / 4,       so |e| <= 2 sqrt(margin / k)
///
/// bounds the work of the next step before it is known. The impedance passivity controller adds damping, implicit as
/// all damping of the virtual mass: as much as turns into heat what the account is short of half of E_0, and never less
/// than k d, the share of this hand in the damping of the loop.
class TdpaForceEnd final : public EnergyBoundedEnd {
 public:
  using EnergyBoundedEnd::EnergyBoundedEnd;
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  void clamp_reference(const AxisArray& x) noexcept TANDEM_REALTIME override;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {.ledger = true}; }

  static constexpr double kDampingMax = 10;  ///< at most [N s/m at the tip]

 private:
  AxisArray last_x_{};  ///< near end at the last tick
};

/// The server's end: the reference makes the received motion. The admittance passivity controller reduces that motion
/// to what the account pays for. The position lost by this is made up for at v_app, as far as the account pays
/// [Artigas, Ryu, Preusche, EuroHaptics 2010].
class TdpaPositionEnd final : public EnergyBoundedEnd {
 public:
  using EnergyBoundedEnd::EnergyBoundedEnd;
  void engage(const AxisArray& x, double age) noexcept TANDEM_REALTIME override;
  const EndState& move(const EndInput& in) noexcept TANDEM_REALTIME override;
  [[nodiscard]] Guarantees guarantees() const noexcept override { return {.ledger = true, .bounded_step = true}; }

 private:
  AxisArray last_rx_{};  ///< received position that the last move has followed
  bool following_ = false;
};

}  // namespace tandem::control
