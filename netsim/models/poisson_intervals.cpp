#include "netsim/models/poisson_intervals.h"

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

enum IntervalPurpose : std::uint64_t { kIntervalStart = 1, kIntervalLength };

/// Returns the slot length. It is at least the longest interval, so that intervals of at most two slots cover any time.
Duration slot_length(double rate_per_s, double cap) noexcept {
  if (!(rate_per_s > 0)) return Duration{1};
  return std::max(Duration{static_cast<std::int64_t>(cap)}, from_seconds(std::min(1.0 / rate_per_s, 3600.0)));
}

}  // namespace

double LengthLaw::at(double u) const noexcept {
  switch (kind) {
    case Kind::kUniform:
      return std::min(cap, low + (high - low) * u);
    case Kind::kExponential:
      return std::min(cap, low * exponential_quantile(u));
    case Kind::kPareto:
      return std::min(cap, low * pareto_quantile(u, alpha));
    case Kind::kParetoII:
      return std::min(cap, low * (pareto_quantile(u, alpha) - 1));
  }
  return 0;
}

PoissonIntervals::PoissonIntervals(double rate_per_s, const LengthLaw& length, RandomKey key) noexcept
    : rate_(rate_per_s),
      length_(length),
      slot_length_(slot_length(rate_per_s, length.cap)),
      start_key_(key.derive(kIntervalStart)),
      length_key_(key.derive(kIntervalLength)) {}

const PoissonIntervals::Slot& PoissonIntervals::slot(std::int64_t number) noexcept {
  Slot& slot = slots_[static_cast<std::size_t>(number) % kSlotsCached];
  if (slot.number == number) return slot;
  slot.number = number;
  slot.count = 0;
  const double length = static_cast<double>(slot_length_.count());
  const double mean_gap = 1e9 / rate_;
  double start = 0;
  for (std::size_t i = 0; i < kPerSlotMax; ++i) {
    const std::uint64_t counter = static_cast<std::uint64_t>(number) * kPerSlotMax + i;
    start += mean_gap * exponential_quantile(start_key_.uniform(counter));
    if (start >= length) break;
    const Time begin = Time{slot_length_ * number} + Duration{static_cast<std::int64_t>(start)};
    const Duration lasts{static_cast<std::int64_t>(length_.at(length_key_.uniform(counter)))};
    slot.intervals[slot.count++] = {begin, begin + lasts};
  }
  return slot;
}

bool PoissonIntervals::begun_within(Time t, Duration window) noexcept {
  if (!(rate_ > 0) || window == Duration::zero()) return false;
  bool any = false;
  begun(t - window, t, [&any](const Interval&) { any = true; });
  return any;
}

Time PoissonIntervals::chain_end(Time t) noexcept {
  // Follows chains of overlapping intervals. The bound of 64 is safe: rate * cap <= 32 makes longer chains practically
  // impossible. A truncated chain only ends a little earlier.
  for (int step = 0; step < 64; ++step) {
    Time end = t;  // an interval is at most as long as a slot: older ones ended by now
    begun(t - slot_length_, t, [&end](const Interval& interval) { end = std::max(end, interval.end); });
    if (end == t) break;
    t = end;
  }
  return t;
}

}  // namespace tandem::netsim
