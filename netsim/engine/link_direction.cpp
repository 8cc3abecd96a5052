#include "netsim/engine/link_direction.h"

#include <algorithm>
#include <utility>

namespace tandem::netsim {

Outcome LinkDirection::enter(const PathDecision& decision, DelayQueue& queue, const Ingress& entrance,
                             std::span<const std::byte> bytes) noexcept {
  const Outcome outcome = submit(decision, queue, counters, tap, entrance, bytes);
  if (outcome == Outcome::kWaiting && timeline_) timeline_->defer(entrance.now, flow_, queue.newest());
  return outcome;
}

/// Returns the capacity for 10.5 s of 1 kHz traffic plus 1.1 times the longest model delay, multiplied by (1 + copies).
/// Upper bound: two minutes of traffic; datagrams beyond it count as overflow.
std::size_t slots_for(Duration delay_max, double copies) noexcept {
  constexpr double kPerSecond = 1000;
  const double room = kPerSecond * (10.5 + 1.1 * seconds(delay_max));
  return static_cast<std::size_t>(std::min(room * (1 + copies), 120'000.0));
}

std::size_t slots_for(const LinkSchedule& schedule, Direction direction) noexcept {
  const auto needs = [direction](const LinkSpec& link) {
    const PathSpec& spec = link[direction];
    return slots_for(delay_max(spec), spec.duplicate.probability);
  };
  std::size_t most = needs(schedule.initial);
  for (const LinkSchedule::Change& change : schedule.changes) most = std::max(most, needs(change.link));
  return most;
}

}  // namespace tandem::netsim
