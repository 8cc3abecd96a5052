#include "netsim/engine/submit.h"

#include "netsim/quality/link_monitor.h"

namespace tandem::netsim {
namespace {

Decision about(const DelayQueue::Item& item, const DecisionTap& tap) noexcept {
  return {.in = item.sent,
          .out = item.at,
          .index = item.index,
          .link = tap.link,
          .flow = tap.flow,
          .size = item.size_in,
          .direction = tap.direction,
          .outcome = item.waiting     ? Outcome::kWaiting
                     : item.held_back ? Outcome::kHeldBack
                                      : Outcome::kDeliver,
          .copy = item.copy,
          .in_flight = false,
          .corruption = item.corruption};
}

void let_in(const PathDecision& decision, PathCounters& counters) noexcept {
  counters.count(decision.outcome);
  if (decision.copied && !dropped(decision.copy_outcome)) ++counters.copies;
  if (decision.corruption.kind == Corruption::Kind::kBitFlips) ++counters.flipped;
  if (decision.corruption.kind == Corruption::Kind::kTruncated) ++counters.truncated;
}

}  // namespace

std::uint64_t PathCounters::dropped() const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    if (netsim::dropped(static_cast<Outcome>(i))) sum += by_outcome[i];
  }
  return sum;
}

Outcome submit(const PathDecision& decision, DelayQueue& queue, PathCounters& counters, const DecisionTap& tap,
               const Ingress& entrance, std::span<const std::byte> bytes) noexcept {
  ++counters.in;
  counters.bytes_in += bytes.size();
  if (tap.monitor != nullptr) tap.monitor->sent(tap.direction, entrance.now, decision.index);
  const auto drop = [&](Outcome reason, bool copy, Time at) {
    leave({.sent = entrance.now,
           .index = decision.index,
           .size_in = static_cast<std::uint32_t>(bytes.size()),
           .copy = copy,
           .at = at},
          bytes.size(), reason, counters, tap);
  };
  if (decision.copied && dropped(decision.copy_outcome)) {
    ++counters.copies;
    drop(decision.copy_outcome, true, decision.at + decision.copy_delay);
  }
  if (dropped(decision.outcome)) {
    drop(decision.outcome, false, decision.at);
    return decision.outcome;
  }
  const auto entered = queue.enter(decision, entrance.now, entrance.path_index, bytes, entrance.tag);
  if (entered == DelayQueue::Entered::kNo) {
    const Outcome reason = bytes.size() > kSlotBytes ? Outcome::kTooLong : Outcome::kOverflow;
    drop(reason, false, entrance.now);
    return reason;
  }
  if (decision.outcome == Outcome::kWaiting) return decision.outcome;
  let_in(decision, counters);
  if (entered == DelayQueue::Entered::kNoCopy) drop(Outcome::kOverflow, true, entrance.now);
  return decision.outcome;
}

void resolve(const PathDecision& decision, std::uint32_t slot, DelayQueue& queue, PathCounters& counters,
             const DecisionTap& tap) noexcept {
  const DelayQueue::Item item = queue.peek(slot, decision.at);
  const std::size_t size = queue.bytes(item).size();
  if (dropped(decision.outcome)) {
    leave(item, size, decision.outcome, counters, tap);
    queue.revoke(slot);
    return;
  }
  const auto entered = queue.decide(slot, decision);
  let_in(decision, counters);
  if (entered != DelayQueue::Entered::kNoCopy) return;
  DelayQueue::Item copy = item;
  copy.copy = true;
  leave(copy, size, Outcome::kOverflow, counters, tap);
}

void leave(const DelayQueue::Item& item, std::size_t size, Outcome outcome, PathCounters& counters,
           const DecisionTap& tap) noexcept {
  if (dropped(outcome)) {
    counters.count(outcome);
    // A datagram in flight to a client that left does not count as a loss.
    const bool lost = !item.copy && outcome != Outcome::kClientGone;
    if (tap.monitor != nullptr && lost) tap.monitor->lost(tap.direction, item.sent, item.index);
  } else {
    if (tap.monitor != nullptr) tap.monitor->arrived(tap.direction, item.sent, item.at, item.index);
    ++counters.out;
    counters.bytes_out += size;
    counters.delay_sum_ns += (item.at - item.sent).count();
  }
  if (tap.sink == nullptr) return;
  Decision decision = about(item, tap);
  if (dropped(outcome)) {
    decision.outcome = outcome;
    decision.corruption = {};
  }
  tap.sink->decided(decision);
}

void log_undelivered(const DelayQueue::Item& item, const DecisionTap& tap) noexcept {
  if (tap.sink == nullptr) return;
  Decision decision = about(item, tap);
  decision.in_flight = true;
  tap.sink->decided(decision);
}

}  // namespace tandem::netsim
