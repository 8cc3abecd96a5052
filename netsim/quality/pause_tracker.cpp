#include "netsim/quality/pause_tracker.h"

#include <algorithm>

namespace tandem::netsim {

const PauseTracker::Resume* PauseTracker::find(Time after, Time until, bool newest) const noexcept {
  const Resume* found = nullptr;
  for (std::uint64_t back = 1; back <= std::min<std::uint64_t>(count_, kKept); ++back) {
    const Resume& resume = resumes_[(count_ - back) % kKept];
    if (resume.at <= after || (newest && found != nullptr)) break;
    if (resume.at <= until) found = &resume;
  }
  return found;
}

}  // namespace tandem::netsim
