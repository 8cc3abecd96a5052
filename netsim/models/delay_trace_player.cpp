#include "netsim/models/delay_trace_player.h"

#include <algorithm>

namespace tandem::netsim {

DelayTrace::Step DelayTracePlayer::at(Time t) noexcept {
  const auto& steps = trace_->steps;
  const Duration into = t.time_since_epoch() % trace_->period;
  // Time usually advances by at most two steps; search only if it does not.
  for (int tries = 0; tries < 3; ++tries) {
    const bool begun = steps[here_].at <= into;
    const bool over = here_ + 1 < steps.size() && steps[here_ + 1].at <= into;
    if (begun && !over) return steps[here_];
    if (!begun) break;
    ++here_;
  }
  const auto next = std::upper_bound(steps.begin(), steps.end(), into,
                                     [](Duration d, const DelayTrace::Step& step) { return d < step.at; });
  here_ = static_cast<std::size_t>(next - steps.begin()) - 1;  // the first step begins at 0
  return steps[here_];
}

}  // namespace tandem::netsim
