#pragma once

#include "netsim/system/observed_seat.h"

namespace tandem::netsim {

/// Checks the guards of one client against its own device. The client must release a hand whose readings are invalid or
/// frozen, which moves faster than users move, or whose motors are too hot.
class DeviceGuardChecker {
 public:
  /// Checks a tick in which the client ran.
  void check(const ObservedSeat& seat);

 private:
  void check_frozen_sensor(const ObservedSeat& seat);

  unsigned invalid_readings_ = 0, fast_ = 0, hot_ = 0;  ///< consecutive ticks
  struct Frozen {                                       ///< state at the time when the reading froze
    Time since{};
    AxisArray ref{}, effort{};
    bool on = false;
  } frozen_;
};

}  // namespace tandem::netsim
