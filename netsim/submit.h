#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/delay_queue.h"
#include "netsim/path.h"

namespace tandem::netsim {

/// What one direction of one link did so far. Invariant at every instant: in + copies = out + dropped() + in_flight().
struct PathCounters {
  std::uint64_t in = 0;                               ///< datagrams sent into it
  std::uint64_t copies = 0;                           ///< made by duplication
  std::uint64_t out = 0;                              ///< handed to the receiver
  std::array<std::uint64_t, kOutcomes> by_outcome{};  ///< verdicts; kOverflow also counts copies that found no room
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::int64_t delay_sum_ns = 0;  ///< of all that came out [ns]

  [[nodiscard]] std::uint64_t of(Outcome outcome) const noexcept {
    return by_outcome[static_cast<std::size_t>(outcome)];
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept;
  [[nodiscard]] std::uint64_t in_flight() const noexcept { return in + copies - out - dropped(); }

  /// A datagram of `size` bytes came out.
  void left(const DelayQueue::Item& item, std::size_t size) noexcept;
};

/// The one way into the network, live and virtual: decide, count, keep. `queue` may be shared by many paths.
/// @return what was decided; kOverflow or kTooLong when the queue could not keep what the path would have delivered
Outcome submit(Path& path, DelayQueue& queue, PathCounters& counters, Time now, std::uint32_t lane,
               std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

}  // namespace tandem::netsim
