#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/time.h"
#include "netsim/models/corruption.h"

namespace tandem::netsim {

/// Maximum datagram size of the stores [bytes]: an Ethernet payload.
inline constexpr std::size_t kSlotBytes = 1500;

/// PathDecision on a datagram: delivery, or the reason of its drop.
enum class Outcome : std::uint8_t {
  kDeliver,     ///< arrives at `PathDecision::at`
  kHeldBack,    ///< held back for reordering; Path releases it, at `PathDecision::at` at the latest
  kOutage,      ///< dropped: link down
  kHoldFull,    ///< dropped: link down and its hold buffer full
  kLost,        ///< dropped: random loss
  kQueueFull,   ///< dropped: tail drop of the rate's queue
  kOverflow,    ///< dropped by the store, not by a model: too many datagrams in flight
  kTooLong,     ///< dropped by the store: larger than a slot
  kCorrupted,   ///< dropped: corrupted, detected by the checksum
  kAboveMtu,    ///< dropped: larger than the MTU of the path
  kOldAddress,  ///< dropped on arrival: the destination address is dead
  kClientGone,  ///< dropped in flight: its client left (proxy)
  kPushedOut,   ///< dropped: longest-waiting datagram of a drop-head queue
  kReplaced,    ///< dropped: link down, and a newer datagram replaced it
  kWaiting,     ///< undecided; Path::resolve returns the final decision
};
inline constexpr std::size_t kOutcomes = 15;
/// Returns the name of an outcome, as in logs and reports.
[[nodiscard]] const char* name(Outcome outcome) noexcept;
/// Returns whether the outcome is a drop.
[[nodiscard]] constexpr bool dropped(Outcome o) noexcept { return o >= Outcome::kOutage && o != Outcome::kWaiting; }

/// Release of a datagram that was held back.
struct Release {
  std::uint64_t index = 0;  ///< index of the held-back datagram
  Time at;                  ///< arrival time; earlier than the limit of its decision
};

/// Decision of a path on one datagram.
struct PathDecision {
  Outcome outcome = Outcome::kDeliver;
  std::uint64_t index = 0;  ///< index of this datagram in its flow, from 0
  Time at = {};             ///< arrival; kHeldBack: latest arrival; dropped: time of the drop
  bool copied = false;      ///< a copy arrives `copy_delay` after the original
  Duration copy_delay{};
  /// If not kDeliver: the copy is dropped for this reason at `at + copy_delay`. Only a replay sets it; models never do.
  Outcome copy_outcome = Outcome::kDeliver;
  Corruption corruption = {};  ///< difference between sent and delivered bytes
  /// Held-back datagrams of this flow that this datagram releases. Valid until the next call.
  std::span<const Release> released = {};
};

}  // namespace tandem::netsim
