#pragma once

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/path_spec.h"
#include "netsim/models/poisson_intervals.h"

namespace tandem::netsim {

/// Stalls: the network delivers nothing for a time, then everything at once. Examples: Wi-Fi scans, retransmission,
/// handover.
class Stalls {
 public:
  Stalls(const StallSpec& spec, RandomKey key) noexcept
      : intervals_(spec.rate_per_s,
                   {.kind = LengthLaw::Kind::kPareto,
                    .low = static_cast<double>(spec.length_min.count()),
                    .alpha = spec.alpha,
                    .cap = static_cast<double>(spec.cap.count())},
                   key) {}

  /// Returns the departure time of a datagram due at `t`: `t`, or the end of the stalls that cover it.
  [[nodiscard]] Time release(Time t) noexcept { return intervals_.end_of_chain(t); }

 private:
  PoissonIntervals intervals_;
};

}  // namespace tandem::netsim
