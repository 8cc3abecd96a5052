#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/time.h"
#include "netsim/damage.h"

namespace tandem::netsim {

/// What happened to a datagram at the entrance, or the reason why it will not come out.
enum class Outcome : std::uint8_t {
  kDeliver,     ///< comes out at `Verdict::at`
  kHeldBack,    ///< chosen to be reordered: comes out when Path says so, at `Verdict::at` at the latest
  kOutage,      ///< dropped: link down
  kHoldFull,    ///< dropped: link down and its hold full
  kLost,        ///< dropped: random loss
  kQueueFull,   ///< dropped: tail of the rate's queue
  kOverflow,    ///< dropped by the store, not by the model: too many datagrams in flight
  kTooLong,     ///< dropped by the store: larger than a slot
  kCorrupted,   ///< dropped: damaged under way, the checksum tells
  kAboveMtu,    ///< dropped: larger than the path lets through
  kOldAddress,  ///< dropped at its arrival: sent to an address that the client has left
  kClientGone,  ///< dropped while under way: its client left (proxy)
  kPushedOut,   ///< dropped: waited longest in a queue that makes room at its head
  kReplaced,    ///< dropped: link down, and only the newest is kept
  kWaiting,     ///< not decided yet: comes out, or not, when Path::settle says so
};
inline constexpr std::size_t kOutcomes = 15;
[[nodiscard]] const char* name(Outcome outcome) noexcept;
[[nodiscard]] constexpr bool dropped(Outcome o) noexcept { return o >= Outcome::kOutage && o != Outcome::kWaiting; }

/// A datagram held back earlier that may now come out.
struct Release {
  std::uint64_t index = 0;  ///< of the datagram held back
  Time at;                  ///< when it comes out; earlier than the limit of its verdict
};

struct Verdict {
  Outcome outcome = Outcome::kDeliver;
  std::uint64_t index = 0;  ///< of this datagram in its flow, from 0
  Time at;                  ///< arrival; kHeldBack: latest arrival; dropped: the time of sending, or of being pushed out
  bool copied = false;      ///< a second one comes out `copy_delay` after the first
  Duration copy_delay{};
  /// Not delivered: the copy is dropped, for this reason, at `at + copy_delay`; models never say so, a replay does.
  Outcome copy_outcome = Outcome::kDeliver;
  Damage damage = {};  ///< what comes out is not what went in
  /// Datagrams of this flow held back that this one lets go. Valid until the next call.
  std::span<const Release> released;
};

}  // namespace tandem::netsim
