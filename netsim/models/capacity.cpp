#include "netsim/models/capacity.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim {
namespace {

constexpr std::uint64_t kOpportunityBytes = 1500;
constexpr Duration kMillisecond{1'000'000};

}  // namespace

Time CapacityTracePlayer::at(const Place& place) const noexcept {
  return Time{trace_->period * place.cycle + kMillisecond * trace_->entries[place.entry].ms};
}

/// Begins the entry of `place`; behind the last one the recording begins again.
void CapacityTracePlayer::enter(Place& place) const noexcept {
  if (place.entry == trace_->entries.size()) {
    place.entry = 0;
    ++place.cycle;
  }
  place.left = trace_->entries[place.entry].opportunities * kOpportunityBytes;
}

Time CapacityTracePlayer::offer(Time now, std::uint64_t bytes) noexcept {
  offered_ = here_;
  const Time earliest{now.time_since_epoch() / kMillisecond * kMillisecond};
  const auto& entries = trace_->entries;
  if (!begun_ || at(offered_) < earliest) {
    offered_.cycle = earliest.time_since_epoch() / trace_->period;
    const std::int64_t into = (earliest.time_since_epoch() - trace_->period * offered_.cycle) / kMillisecond;
    const auto found =
        std::lower_bound(entries.begin(), entries.end(), into,
                         [](const CapacityTrace::Entry& entry, std::int64_t ms) { return entry.ms < ms; });
    offered_.entry = static_cast<std::size_t>(found - entries.begin());
    enter(offered_);
  }
  while (bytes > offered_.left) {
    bytes -= offered_.left;
    ++offered_.entry;
    enter(offered_);
  }
  offered_.left -= bytes;
  return std::max(now, at(offered_));
}

void Backlog::advance(Time now) noexcept {
  while (count_ > 0 && ring_[first_].departure <= now) {
    bytes_ -= ring_[first_].bytes;
    first_ = first_ + 1 == ring_.size() ? 0 : first_ + 1;
    --count_;
  }
}

void Backlog::replace(const Backlog& before) noexcept {
  first_ = count_ = 0;
  bytes_ = 0;
  const std::size_t taken = std::min(before.count_, ring_.size());
  for (std::size_t i = before.count_ - taken; i < before.count_; ++i) {
    const Entry& entry = before.ring_[(before.first_ + i) % before.ring_.size()];
    add(entry.departure, entry.bytes);
  }
}

void Backlog::add(Time departure, std::uint64_t bytes) noexcept {
  ring_[(first_ + count_) % ring_.size()] = {departure, bytes};
  ++count_;
  bytes_ += bytes;
}

Time CoDel::next(Time from) const noexcept {
  const double gap = static_cast<double>(spec_.interval.count()) / std::sqrt(static_cast<double>(count_));
  return from + Duration{static_cast<std::int64_t>(gap)};
}

bool CoDel::drops(Time begin, Duration wait) noexcept {
  bool may = false;
  if (wait < spec_.target) {
    first_above_.reset();
  } else if (!first_above_) {
    first_above_ = begin + spec_.interval;
  } else {
    may = begin >= *first_above_;
  }
  if (!may) {
    dropping_ = false;
    return false;
  }
  if (dropping_) {
    if (begin < drop_next_) return false;
    ++count_;
    drop_next_ = next(drop_next_);
    return true;
  }
  const std::uint64_t since = count_ - last_count_;
  count_ = since > 1 && begin - drop_next_ < 16 * spec_.interval ? since : 1;
  last_count_ = count_;
  dropping_ = true;
  drop_next_ = next(begin);
  return true;
}

}  // namespace tandem::netsim
