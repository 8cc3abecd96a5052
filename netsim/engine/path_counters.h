#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "netsim/engine/path_decision.h"

namespace tandem::netsim {

/// Counters of one direction of one link. Invariant at all times: in + copies = out + dropped() + in_flight().
struct PathCounters {
  std::uint64_t in = 0;      ///< datagrams sent into it
  std::uint64_t copies = 0;  ///< copies made by duplication
  std::uint64_t out = 0;     ///< datagrams delivered to the receiver
  /// Decisions on datagrams, by outcome. A datagram dropped after acceptance counts twice: as delivered and as dropped.
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

}  // namespace tandem::netsim
