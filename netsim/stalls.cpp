#include "netsim/stalls.h"

#include <algorithm>

#include "netsim/quantiles.h"

namespace tandem::netsim {
namespace {

enum Purpose : std::uint64_t { kStart = 1, kLength };

/// A slot is at least as long as the longest stall, so that only two of them can cover a moment.
Duration slot_length(const StallSpec& spec) noexcept {
  if (!(spec.rate_per_s > 0)) return Duration{1};
  return std::max(spec.cap, from_seconds(std::min(1.0 / spec.rate_per_s, 3600.0)));
}

}  // namespace

Stalls::Stalls(const StallSpec& spec, RandomKey key) noexcept
    : rate_(spec.rate_per_s),
      length_min_(static_cast<double>(spec.length_min.count())),
      alpha_(spec.alpha),
      cap_(static_cast<double>(spec.cap.count())),
      slot_length_(slot_length(spec)),
      start_key_(key.derive(kStart)),
      length_key_(key.derive(kLength)) {}

const Stalls::Slot& Stalls::slot(std::int64_t number) noexcept {
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
    const double stall = std::min(cap_, length_min_ * pareto_quantile(length_key_.uniform(counter), alpha_));
    const Time begin = Time{slot_length_ * number} + Duration{static_cast<std::int64_t>(start)};
    slot.stalls[slot.count++] = {begin, begin + Duration{static_cast<std::int64_t>(stall)}};
  }
  return slot;
}

Time Stalls::release_held(Time t) noexcept {
  // A stall may begin before another ends; follow the chain. Bounded: rate * cap <= 32 makes longer chains impossible
  // to meet in practice, and cutting one off only lets datagrams out a little earlier.
  for (int step = 0; step < 64; ++step) {
    const std::int64_t here = t.time_since_epoch() / slot_length_;
    Time end = t;
    for (std::int64_t number = std::max<std::int64_t>(here - 1, 0); number <= here; ++number) {
      const Slot& candidates = slot(number);
      for (std::size_t i = 0; i < candidates.count && candidates.stalls[i].start <= t; ++i) {
        end = std::max(end, candidates.stalls[i].end);
      }
    }
    if (end == t) break;
    t = end;
  }
  return t;
}

}  // namespace tandem::netsim
