#pragma once

#include "common/base/time.h"

namespace tandem::netsim {

/// Returns how far CLOCK_REALTIME is ahead of CLOCK_MONOTONIC. A pause of the thread between two readings of the clocks
/// falsifies that difference: of three attempts the shortest counts. The monotonic clock is read last, so that the
/// remaining error makes datagrams seem to arrive later. An earlier arrival would shorten the delay of the link.
/// @param monotonic, wall  return the time of these clocks now
template <class Monotonic, class Wall>
Duration wall_clock_lead(Monotonic monotonic, Wall wall) noexcept {
  constexpr Duration kUnpaused{2'000};
  Duration lead{}, shortest = Duration::max();
  for (int attempt = 0; attempt < 3 && shortest >= kUnpaused; ++attempt) {
    const Duration before = monotonic(), realtime = wall(), after = monotonic();
    if (after - before >= shortest) continue;
    shortest = after - before;
    lead = realtime - after;
  }
  return lead;
}

}  // namespace tandem::netsim
