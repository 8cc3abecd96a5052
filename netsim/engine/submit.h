#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/decision_log.h"
#include "netsim/engine/delay_queue.h"
#include "netsim/engine/path.h"

namespace tandem::netsim {

/// Counters of one direction of one link. Invariant at all times: in + copies = out + dropped() + in_flight().
struct PathCounters {
  std::uint64_t in = 0;      ///< datagrams sent into it
  std::uint64_t copies = 0;  ///< copies made by duplication
  std::uint64_t out = 0;     ///< datagrams delivered to the receiver
  /// Verdicts on datagrams, by outcome. A datagram dropped after acceptance counts twice: as delivered and as dropped.
  /// A copy counts only when it is dropped.
  std::array<std::uint64_t, kOutcomes> by_outcome{};
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::int64_t delay_sum_ns = 0;  ///< sum over all delivered datagrams [ns]
  /// Accepted datagrams with changed bytes: flipped bits, or truncated.
  std::uint64_t flipped = 0, truncated = 0;

  [[nodiscard]] std::uint64_t of(Outcome outcome) const noexcept {
    return by_outcome[static_cast<std::size_t>(outcome)];
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept;
  [[nodiscard]] std::uint64_t in_flight() const noexcept { return in + copies - out - dropped(); }
  void count(Outcome outcome) noexcept { ++by_outcome[static_cast<std::size_t>(outcome)]; }
};

/// Entry data of a datagram.
struct Ingress {
  Time now;
  std::uint32_t path_index = 0;  ///< the caller's number of the path
  std::uint32_t tag = 0;         ///< returned with the datagram
};

/// Enters a datagram into the network: counts, stores and logs it. The live and the virtual network use no other entry.
/// Several paths may share `queue`.
/// @return outcome; kOverflow or kTooLong if the queue could not store a datagram to be delivered
Outcome submit(const Verdict& verdict, DelayQueue& queue, PathCounters& counters, const DecisionTap& tap,
               const Ingress& entrance, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

/// Applies the final verdict on the datagram that waits in `slot`: counts, schedules or frees it, and logs.
void resolve(const Verdict& verdict, std::uint32_t slot, DelayQueue& queue, PathCounters& counters,
             const DecisionTap& tap) noexcept TANDEM_REALTIME;

/// Records the end of an item taken from the queue: delivered, or dropped on arrival. The network has no other exit.
void leave(const DelayQueue::Item& item, std::size_t size, Outcome outcome, PathCounters& counters,
           const DecisionTap& tap) noexcept TANDEM_REALTIME;

/// Logs an item that is still in the queue when a log ends.
void log_undelivered(const DelayQueue::Item& item, const DecisionTap& tap) noexcept;

}  // namespace tandem::netsim
