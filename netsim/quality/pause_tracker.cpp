#include "netsim/quality/pause_tracker.h"

#include <algorithm>

namespace tandem::netsim {

const PauseTracker::Resume* PauseTracker::first_in(Time after, Time until) const noexcept {
  const Resume* found = nullptr;
  for (std::uint64_t back = 1; back <= std::min<std::uint64_t>(count_, kKept); ++back) {
    const Resume& resume = resumes_[(count_ - back) % kKept];
    if (resume.at <= after) break;
    if (resume.at <= until) found = &resume;
  }
  return found;
}

const PauseTracker::Resume* PauseTracker::last_in(Time after, Time until) const noexcept {
  for (std::uint64_t back = 1; back <= std::min<std::uint64_t>(count_, kKept); ++back) {
    const Resume& resume = resumes_[(count_ - back) % kKept];
    if (resume.at <= after) break;
    if (resume.at <= until) return &resume;
  }
  return nullptr;
}

}  // namespace tandem::netsim
