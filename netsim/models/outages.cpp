#include "netsim/models/outages.h"

#include <algorithm>

namespace tandem::netsim {

OutageGate::OutageGate(const std::vector<OutageSpec>& outages, RandomKey key, RandomKey all_key) {
  for (std::size_t i = 0; i < outages.size(); ++i) {
    Outage& outage = outages_.emplace_back(Outage{outages[i], std::nullopt});
    const RandomKey own = (outages[i].scope == OutageSpec::Scope::kAll ? all_key : key).derive(i);
    outage.length_key = own;
    if (outages[i].mean_gap == Duration::zero()) continue;
    const LengthLaw law{.low = static_cast<double>(outages[i].length.count()),
                        .high = static_cast<double>(outages[i].length_max.count()),
                        .cap = static_cast<double>(outages[i].length_max.count())};
    outage.random = random_.size();
    random_.emplace_back(1 / seconds(outages[i].mean_gap), law, own);
  }
}

std::optional<Time> OutageGate::end_of(const Outage& outage, Time t) noexcept {
  if (!outage.random) {
    const OutageSpec& spec = outage.spec;
    if (spec.length_max == Duration::zero() || t.time_since_epoch() < spec.start) return end_of(spec, t);
    OutageSpec drawn = spec;
    const auto number = static_cast<std::uint64_t>((t.time_since_epoch() - spec.start) / spec.period);
    const double more = static_cast<double>((spec.length_max - spec.length).count()) + 1;
    drawn.length += Duration{static_cast<std::int64_t>(outage.length_key.uniform(number) * more)};
    return end_of(drawn, t);
  }
  const Time end = random_[*outage.random].end_of_chain(t);
  return end > t ? std::optional{end} : std::nullopt;
}

bool OutageGate::in_start_loss_window(const Outage& outage, Time t) noexcept {
  const OutageSpec& spec = outage.spec;
  if (spec.loss_at_start == Duration::zero()) return false;
  if (outage.random) return random_[*outage.random].begun_within(t, spec.loss_at_start);
  const Duration since = t.time_since_epoch() - spec.start;
  return (spec.period > Duration::zero() ? since % spec.period : since) < spec.loss_at_start;
}

std::optional<Time> OutageGate::end_of(const OutageSpec& spec, Time t) noexcept {
  const Duration since = t.time_since_epoch() - spec.start;
  if (since < Duration::zero()) return std::nullopt;
  const Duration into = spec.period > Duration::zero() ? since % spec.period : since;
  if (into >= spec.length) return std::nullopt;
  return t + (spec.length - into);
}

OutageGate::Passage OutageGate::enter_any(Time now, std::size_t size) noexcept {
  Passage passage{State::kUp, now};

  std::optional<std::uint64_t> room;  // smallest limit of the active holds
  bool newest = false;                // true if any active outage keeps only the newest
  for (const Outage& outage : outages_) {
    const auto end = end_of(outage, now);
    if (!end) continue;
    if (outage.spec.mode == OutageSpec::Mode::kDrop || in_start_loss_window(outage, now)) return {State::kDropped, now};
    if (outage.spec.mode == OutageSpec::Mode::kHoldLast) newest = true;
    passage.at = std::max(passage.at, *end);
    if (outage.spec.hold_bytes > 0) room = std::min(room.value_or(outage.spec.hold_bytes), outage.spec.hold_bytes);
  }
  if (passage.at == now) return passage;

  // Another outage may begin before this one ends; held datagrams then stay held. Each round checks every outage once.
  // The limit of 8 rounds bounds the loop for schedules without any gap.
  bool extended = true;
  for (int round = 0; extended && round < 8; ++round) {
    extended = false;
    for (const Outage& outage : outages_) {
      if (const auto end = end_of(outage, passage.at)) {
        passage.at = *end;
        extended = true;
      }
    }
  }
  // Newest-only mode continues until the link is up. A datagram in a plain hold would otherwise be decided earlier and
  // overtake the newest one.
  if (newest || now < newest_until_) {
    held_until_ = newest_until_ = std::max(held_until_, passage.at);
    return {State::kNewest, held_until_};
  }
  if (now >= held_until_) held_bytes_ = 0;
  if (room && held_bytes_ + size > *room) return {State::kHoldFull, now};
  held_bytes_ += size;
  held_until_ = std::max(held_until_, passage.at);
  passage.at = held_until_;
  return passage;
}

}  // namespace tandem::netsim
