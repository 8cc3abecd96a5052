#pragma once

#include <cstdint>

#include "netsim/system/observed_seat.h"
#include "netsim/system/silence_energy.h"

namespace tandem::netsim {

/// Checks that one client alone releases its hand when the server falls silent, or when its loop is too old. During a
/// silence the motor delivers no more energy than the tank of its gate. The energy is the motor's work, not the gate's
/// own account.
class SilenceChecker {
 public:
  /// Checks the energy of a tick, whether or not the client ran in it. Call it before `check`.
  void check_energy(const ObservedSeat& seat);
  /// Checks the gate after a tick in which the client ran.
  void check(const ObservedSeat& seat);

 private:
  std::uint64_t trips_ = 0;   ///< of its gate
  Time arrived_{}, fresh_{};  ///< when the last fresh datagram arrived: on the seat's clock, on the simulation's
  double limit_ = 0;          ///< longest silence limit since then [s]
  SilenceEnergy energy_;      ///< that the motor delivered since then and since the gate's release
  Time ran_{};                ///< when its program last ran
};

}  // namespace tandem::netsim
