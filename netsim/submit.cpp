#include "netsim/submit.h"

#include "netsim/link_watch.h"

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
          .under_way = false,
          .damage = item.damage};
}

void let_in(const Verdict& verdict, PathCounters& counters) noexcept {
  counters.count(verdict.outcome);
  if (verdict.copied && !dropped(verdict.copy_outcome)) ++counters.copies;
  if (verdict.damage.kind == Damage::Kind::kBitFlips) ++counters.flipped;
  if (verdict.damage.kind == Damage::Kind::kTruncated) ++counters.truncated;
}

}  // namespace

std::uint64_t PathCounters::dropped() const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    if (netsim::dropped(static_cast<Outcome>(i))) sum += by_outcome[i];
  }
  return sum;
}

Outcome submit(const Verdict& verdict, DelayQueue& queue, PathCounters& counters, const DecisionTap& tap,
               const Entrance& entrance, std::span<const std::byte> bytes) noexcept {
  ++counters.in;
  counters.bytes_in += bytes.size();
  if (tap.watch != nullptr) tap.watch->sent(tap.direction, entrance.now, verdict.index);
  const auto drop = [&](Outcome reason, bool copy, Time at) {
    counters.count(reason);
    if (tap.watch != nullptr && !copy) tap.watch->lost(tap.direction, entrance.now, verdict.index);
    if (tap.sink == nullptr) return;
    tap.sink->decided({.in = entrance.now,
                       .out = at,
                       .index = verdict.index,
                       .link = tap.link,
                       .flow = tap.flow,
                       .size = static_cast<std::uint32_t>(bytes.size()),
                       .direction = tap.direction,
                       .outcome = reason,
                       .copy = copy,
                       .under_way = false,
                       .damage = {}});
  };
  if (verdict.copied && dropped(verdict.copy_outcome)) {
    ++counters.copies;
    drop(verdict.copy_outcome, true, verdict.at + verdict.copy_delay);
  }
  if (dropped(verdict.outcome)) {
    drop(verdict.outcome, false, verdict.at);
    return verdict.outcome;
  }
  const auto entered = queue.enter(verdict, entrance.now, entrance.lane, bytes, entrance.tag);
  if (entered == DelayQueue::Entered::kNo) {
    const Outcome reason = bytes.size() > kSlotBytes ? Outcome::kTooLong : Outcome::kOverflow;
    drop(reason, false, entrance.now);
    return reason;
  }
  if (verdict.outcome == Outcome::kWaiting) return verdict.outcome;
  let_in(verdict, counters);
  if (entered == DelayQueue::Entered::kNoCopy) drop(Outcome::kOverflow, true, entrance.now);
  return verdict.outcome;
}

void settle(const Verdict& verdict, std::uint32_t slot, DelayQueue& queue, PathCounters& counters,
            const DecisionTap& tap) noexcept {
  const DelayQueue::Item item = queue.peek(slot, verdict.at);
  const std::size_t size = queue.bytes(item).size();
  if (dropped(verdict.outcome)) {
    leave(item, size, verdict.outcome, counters, tap);
    queue.revoke(slot);
    return;
  }
  const auto entered = queue.decide(slot, verdict);
  let_in(verdict, counters);
  if (entered != DelayQueue::Entered::kNoCopy) return;
  DelayQueue::Item copy = item;
  copy.copy = true;
  leave(copy, size, Outcome::kOverflow, counters, tap);
}

void leave(const DelayQueue::Item& item, std::size_t size, Outcome outcome, PathCounters& counters,
           const DecisionTap& tap) noexcept {
  if (dropped(outcome)) {
    counters.count(outcome);
    // What was on its way to a client that left is nobody's loss.
    const bool lost = !item.copy && outcome != Outcome::kClientGone;
    if (tap.watch != nullptr && lost) tap.watch->lost(tap.direction, item.sent, item.index);
  } else {
    if (tap.watch != nullptr) tap.watch->arrived(tap.direction, item.sent, item.at, item.index);
    ++counters.out;
    counters.bytes_out += size;
    counters.delay_sum_ns += (item.at - item.sent).count();
  }
  if (tap.sink == nullptr) return;
  Decision decision = about(item, tap);
  if (dropped(outcome)) {
    decision.outcome = outcome;
    decision.damage = {};
  }
  tap.sink->decided(decision);
}

void tell_waiting(const DelayQueue::Item& item, const DecisionTap& tap) noexcept {
  if (tap.sink == nullptr) return;
  Decision decision = about(item, tap);
  decision.under_way = true;
  tap.sink->decided(decision);
}

}  // namespace tandem::netsim
