#pragma once

#include <array>
#include <cstdint>

#include "client/seat/seat.h"

namespace tandem::netsim {

/// Balances the energy that the motor of one hand delivers under law `replica`, over the whole session:
///
///     G + W  <=  P - (1 - eta) D  +  S  +  W_0
///
/// G    energy that the motor delivered [J], from the end of each ramp until the gate releases the hand.
///      In the ramp the gate's slew limit decides, afterwards its tank does (invariant `loss_energy`).
/// W    stored energy [J]: of the hand's spring (1/2 k_c e^2; linear in e beyond the motor's limit),
///      of the tool's copy (1/2 m v^2), of the spring to the others, of all surfaces.
/// W_0  W at the end of each ramp [J].
/// P    energy that the account paid, minus what it took back and minus its credit for heat [J].
///      Invariant `ledger` limits P to E_0 + E_in.
/// D    heat of the copy [J], the integral of b v^2.
/// S    1/2 k_c |dq|^2 per tick [J]: energy that a sampled spring generates and the device's damping dissipates
///      [Colgate & Schenkel, J. Robotic Systems 14(1) 1997].
///
/// All energy that a hand receives beyond W and S is therefore paid, whichever guard it passes.
/// A seat that leads alone receives nothing else.
/// For a hand on several tools, each sum is weighted as the force of its tool is.
/// For such a hand it judges only the stretches in which the motor delivers all that is wanted.
/// Otherwise the springs to separating tools take up energy at the delivered share of the force and return all of it.
/// The difference is at most 1/2 C_1 C_2 k_c d^2 for two tools at distance d.
class HandEnergyBalance {
 public:
  struct Sample {
    const client::Seat* seat = nullptr;  ///< the seat after its tick
    double motor_max = 0;                ///< largest force that the gate passes [N]
    double motor_work = 0;               ///< energy that the motor delivered since the last sample [J]
    double unaccountable_work = 0;  ///< part of `motor_work` that no client could account for, because its process was
                                    ///< suspended or its sensor wrong [J]
    bool program_restarted = false, account_restarted = false;
  };
  /// @return energy by which the bound is exceeded now [J]; negative while the bound holds
  double excess(const Sample& sample) noexcept;

 private:
  bool known_ = false, active_ = false;
  std::array<double, 3> q_{};
  std::array<std::int64_t, kToolsMax> spent_nj_{};
  double given_ = 0, paid_ = 0, heat_lost_ = 0, sampled_ = 0, begun_ = 0;
};

}  // namespace tandem::netsim
