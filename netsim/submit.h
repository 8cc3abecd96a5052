#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/decision_log.h"
#include "netsim/delay_queue.h"
#include "netsim/path.h"

namespace tandem::netsim {

/// What one direction of one link did so far. Invariant at every instant: in + copies = out + dropped() + in_flight().
struct PathCounters {
  std::uint64_t in = 0;      ///< datagrams sent into it
  std::uint64_t copies = 0;  ///< made by duplication
  std::uint64_t out = 0;     ///< handed to the receiver
  /// Verdicts, of datagrams. What is dropped only after it was let in is there twice: as delivered and as dropped. A
  /// copy counts here only when it is dropped.
  std::array<std::uint64_t, kOutcomes> by_outcome{};
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::int64_t delay_sum_ns = 0;  ///< of all that came out [ns]
  /// Datagrams let in whose bytes were changed under way: bits flipped, cut short.
  std::uint64_t flipped = 0, truncated = 0;

  [[nodiscard]] std::uint64_t of(Outcome outcome) const noexcept {
    return by_outcome[static_cast<std::size_t>(outcome)];
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept;
  [[nodiscard]] std::uint64_t in_flight() const noexcept { return in + copies - out - dropped(); }
  void count(Outcome outcome) noexcept { ++by_outcome[static_cast<std::size_t>(outcome)]; }
};

/// A datagram at the entrance.
struct Entrance {
  Time now;
  std::uint32_t lane = 0;  ///< the caller's name of the path
  std::uint32_t tag = 0;   ///< comes out with the datagram
};

/// The one way into the network, live and virtual: count, keep, tell. `queue` may be shared by many paths.
/// @return what was decided; kOverflow or kTooLong when the queue could not keep what the verdict would have delivered
Outcome submit(const Verdict& verdict, DelayQueue& queue, PathCounters& counters, const DecisionTap& tap,
               const Entrance& entrance, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

/// The verdict about one that `submit` kept waiting in `slot`: count, keep or let go, tell.
void settle(const Verdict& verdict, std::uint32_t slot, DelayQueue& queue, PathCounters& counters,
            const DecisionTap& tap) noexcept TANDEM_REALTIME;

/// The one way out: an item taken from the queue reached the receiver, or was dropped on arrival.
void leave(const DelayQueue::Item& item, std::size_t size, Outcome outcome, PathCounters& counters,
           const DecisionTap& tap) noexcept TANDEM_REALTIME;

/// An item still in the queue when a log ends.
void tell_waiting(const DelayQueue::Item& item, const DecisionTap& tap) noexcept;

}  // namespace tandem::netsim
