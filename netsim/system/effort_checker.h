#pragma once

#include "netsim/system/observed_seat.h"

namespace tandem::netsim {

/// Checks the efforts that one client writes to its device: finite, limited, and no faster than the gate's slew limit.
/// A release to zero is always allowed. The limits are a copy of the design's, not those of the checked gate.
class EffortChecker {
 public:
  /// Checks the effort of a tick in which the client ran.
  void check(const ObservedSeat& seat);

 private:
  AxisArray effort_{};  ///< of the previous tick
  Time run_at_{};       ///< its time on the client's clock; zero: none
};

}  // namespace tandem::netsim
