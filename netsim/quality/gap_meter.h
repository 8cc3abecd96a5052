#pragma once

#include <algorithm>

#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::netsim {

/// Longest gap of each step, gaps that still last included. A gap is a time without an arrival while the sender was
/// sending. It knows the events of closed steps only. Real-time safe.
class GapMeter {
 public:
  /// Events of one step. Each time is that of the last such event in the step.
  struct Step {
    bool talked = false, heard = false, resumed = false;
    Time last_sent, last_heard, resume;
    Duration gap{};  ///< longest gap that ended in this step
  };
  struct Gap {
    Duration length{};
    Time since;  ///< start of the silence at the end of the step
  };
  /// Closes the next step.
  /// @param delay_min  least delay of an arrival: a datagram sent after a pause is due after this time
  Gap close(const Step& step, Duration delay_min) noexcept TANDEM_REALTIME {
    if (step.talked) talked_until_ = step.last_sent;
    if (step.heard) {
      heard_ = true;
      silent_from_ = step.last_heard;
    }
    if (step.resumed) due_ = step.resume + delay_min;
    const Time since = std::max(silent_from_, due_);
    return {heard_ ? std::max(step.gap, talked_until_ - since) : step.gap, since};
  }

 private:
  bool heard_ = false;
  Time silent_from_, talked_until_;
  Time due_;  ///< earliest arrival of the first datagram after a pause
};

}  // namespace tandem::netsim
