#pragma once

#include <cstdint>

#include "netsim/system/hand_energy_balance.h"
#include "netsim/system/observed_seat.h"

namespace tandem::netsim {

/// Checks the energy that the motor of one hand delivers under law `replica` in its whole session (HandEnergyBalance),
/// from the motor's work, the readings and the account's sums. A device drops the effort of a paused program, and a
/// wrong sensor hides motion. In both cases the excess over effort times reading is not charged to the law.
class HandEnergyChecker {
 public:
  /// Checks a tick, whether or not the client ran in it.
  void check(const ObservedSeat& seat);

 private:
  HandEnergyBalance balance_;
  std::uint32_t starts_ = 0, joins_ = 0;  ///< of the client at its last run
  AxisArray effort_{}, x_{};              ///< of the client at its last run
  // Since that run:
  double motor_work_ = 0;  ///< [J]
  unsigned ticks_ = 0;
  bool sensor_failed_ = false;
};

}  // namespace tandem::netsim
