#include "netsim/submit.h"

namespace tandem::netsim {

std::uint64_t PathCounters::dropped() const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    if (netsim::dropped(static_cast<Outcome>(i))) sum += by_outcome[i];
  }
  return sum;
}

void PathCounters::left(const DelayQueue::Item& item, std::size_t size) noexcept {
  ++out;
  bytes_out += size;
  delay_sum_ns += (item.at - item.sent).count();
}

Outcome submit(Path& path, DelayQueue& queue, PathCounters& counters, Time now, std::uint32_t lane,
               std::span<const std::byte> bytes) noexcept {
  ++counters.in;
  counters.bytes_in += bytes.size();
  const auto count = [&counters](Outcome outcome) { ++counters.by_outcome[static_cast<std::size_t>(outcome)]; };
  const Verdict verdict = path.send(now, bytes.size());
  if (dropped(verdict.outcome)) {
    count(verdict.outcome);
    return verdict.outcome;
  }
  const auto entered = queue.enter(verdict, now, lane, bytes);
  if (entered == DelayQueue::Entered::kNo) {
    const Outcome reason = bytes.size() > kSlotBytes ? Outcome::kTooLong : Outcome::kOverflow;
    count(reason);
    return reason;
  }
  if (verdict.copied) {
    ++counters.copies;
    if (entered == DelayQueue::Entered::kNoCopy) count(Outcome::kOverflow);
  }
  count(verdict.outcome);
  return verdict.outcome;
}

}  // namespace tandem::netsim
