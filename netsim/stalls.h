#pragma once

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/path_spec.h"
#include "netsim/poisson_intervals.h"

namespace tandem::netsim {

/// Moments at which the network hands nothing over, then everything at once: Wi-Fi scans, retransmission, handover.
class Stalls {
 public:
  Stalls(const StallSpec& spec, RandomKey key) noexcept
      : intervals_(spec.rate_per_s,
                   {.kind = LengthLaw::Kind::kPareto,
                    .low = static_cast<double>(spec.length_min.count()),
                    .alpha = spec.alpha,
                    .cap = static_cast<double>(spec.cap.count())},
                   key) {}

  /// When something that would leave at `t` leaves: `t`, or the end of the stall(s) that cover it.
  [[nodiscard]] Time release(Time t) noexcept { return intervals_.end_of_chain(t); }

 private:
  PoissonIntervals intervals_;
};

}  // namespace tandem::netsim
