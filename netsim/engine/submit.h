#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/decision_log.h"
#include "netsim/engine/delay_queue.h"
#include "netsim/engine/path.h"
#include "netsim/engine/path_counters.h"

namespace tandem::netsim {

/// Entry data of a datagram.
struct Ingress {
  Time now;
  std::uint32_t path_index = 0;  ///< the caller's number of the path
  std::uint32_t tag = 0;         ///< returned with the datagram
};

/// Enters a datagram into the network: counts, stores and logs it. The live and the virtual network use no other entry.
/// Several paths may share `queue`.
/// @return outcome; kOverflow or kTooLong if the queue could not store a datagram to be delivered
Outcome submit(const PathDecision& decision, DelayQueue& queue, PathCounters& counters, const DecisionTap& tap,
               const Ingress& entrance, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

/// Applies the final decision on the datagram that waits in `slot`: counts, schedules or frees it, and logs.
void resolve(const PathDecision& decision, std::uint32_t slot, DelayQueue& queue, PathCounters& counters,
             const DecisionTap& tap) noexcept TANDEM_REALTIME;

/// Records the end of an item taken from the queue: delivered, or dropped on arrival. The network has no other exit.
void leave(const DelayQueue::Item& item, std::size_t size, Outcome outcome, PathCounters& counters,
           const DecisionTap& tap) noexcept TANDEM_REALTIME;

/// Logs an item that is still in the queue when a log ends.
void log_undelivered(const DelayQueue::Item& item, const DecisionTap& tap) noexcept;

}  // namespace tandem::netsim
