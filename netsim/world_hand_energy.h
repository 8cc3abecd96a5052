#pragma once

#include <array>
#include <cstdint>

#include "client/seat.h"

namespace tandem::netsim {

/// Judges the energy that the motor of one hand gave it under law `replica`, over the whole session:
///
///     G + W  <=  P - (1 - eta) D  +  S  +  W_0
///
/// G    what the motor gave from the end of each ramp until the gate let go [J]. In the ramp the gate's slew decides, afterwards its tank does
///      (invariant `loss_energy`).
/// W    what is stored: in the hand's spring (1/2 k_c e^2; beyond what the motor gives, linear in e), in the copy of the tool (1/2 m v^2), in the
///      spring to the others, in all surfaces. W_0: the same at the end of each ramp.
/// P    what the account paid, minus what it took back and its credit for heat. At most E_0 + E_in, which is the invariant `ledger`.
/// D    heat of the copy, the integral of b v^2
/// S    1/2 k_c |dq|^2 per tick: what a sampled spring makes [Colgate & Schenkel, J. Robotic Systems 14(1) 1997]; the device's damping takes it
///
/// So all that a hand is given beyond what is stored and sampled is paid, whichever guard it passes. Who leads alone is given nothing else.
/// Of a hand on several tools each sum is weighted as its force is, and each stretch is judged in which its motor gives all that is wanted: where it
/// cannot, the springs to tools that part are wound up for the share of their force that is delivered, and come back whole. That is at most
/// 1/2 C_1 C_2 k_c d^2 of two tools d apart.
class HandEnergy {
 public:
  struct Look {
    const client::Seat* seat = nullptr;  ///< just served
    double motor_max = 0;  ///< most that the gate gives [N]
    double worked = 0;     ///< what the motor gave since the last look [J]
    double unknown = 0;    ///< of it, what no client could know: its program slept, or its sensor lied [J]
    bool program_anew = false, account_anew = false;
  };
  /// @return by how much the bound is exceeded now [J]; negative while it holds
  double judge(const Look& look) noexcept;

 private:
  bool known_ = false, active_ = false;
  std::array<double, 3> q_{};
  std::array<std::int64_t, kToolsMax> spent_nj_{};
  double given_ = 0, paid_ = 0, heat_lost_ = 0, sampled_ = 0, begun_ = 0;
};

}  // namespace tandem::netsim
