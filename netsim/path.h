#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/axes.h"
#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/body_delay.h"
#include "netsim/delay_models.h"
#include "netsim/link_rate.h"
#include "netsim/loss.h"
#include "netsim/outages.h"
#include "netsim/path_spec.h"
#include "netsim/stalls.h"
#include "netsim/trace_player.h"

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
};
inline constexpr std::size_t kOutcomes = 12;
[[nodiscard]] const char* name(Outcome outcome) noexcept;
[[nodiscard]] constexpr bool dropped(Outcome o) noexcept { return o >= Outcome::kOutage; }

/// A datagram held back earlier that may now come out.
struct Release {
  std::uint64_t index = 0;  ///< of the datagram held back
  Time at;                  ///< when it comes out; earlier than the limit of its verdict
};

struct Verdict {
  Outcome outcome = Outcome::kDeliver;
  std::uint64_t index = 0;  ///< of this datagram on its path, from 0
  Time at;                  ///< arrival; kHeldBack: latest arrival; dropped: the time of sending
  bool copied = false;      ///< a second one comes out `copy_delay` after the first
  Duration copy_delay{};
  /// Not delivered: the copy is dropped, for this reason, at `at + copy_delay`; models never say so, a replay does.
  Outcome copy_outcome = Outcome::kDeliver;
  /// Datagrams held back that this one lets go. Valid until the next call.
  std::span<const Release> released;
};

/// One direction of one link: tells, for every datagram, whether and when it comes out. It keeps no bytes, reads no
/// clock and takes no memory after construction; decisions are a pure function of (spec, key, times and sizes sent).
///
/// Randomness is drawn per datagram index (loss, body without correlation, duplicate, reorder) or per time slot (bad
/// periods, correlated body, stalls), each purpose with a key of its own, so that no decision moves another.
/// Identity: kFifo and no reordering give `at` that never decreases; `at >= sent + floor` always.
class Path {
 public:
  /// @throws std::invalid_argument listing all problems of the spec.
  /// @param link_key  of what both directions of a link share: the moments of random outages
  Path(const PathSpec& spec, RandomKey key, RandomKey link_key);
  Path(const PathSpec& spec, RandomKey key) : Path(spec, key, key) {}

  /// The key of one direction of one link. `link` is the caller's name for it (seat index, client number).
  [[nodiscard]] static RandomKey key_for(std::uint64_t seed, std::uint64_t link, Direction direction) noexcept {
    return RandomKey{seed}.derive(link).derive(static_cast<std::uint64_t>(direction));
  }

  /// The key both directions of a link share.
  [[nodiscard]] static RandomKey key_for(std::uint64_t seed, std::uint64_t link) noexcept {
    return RandomKey{seed}.derive(link).derive(kDirections);
  }

  /// Decides about one datagram.
  /// @param now   time of sending; a time before that of an earlier call counts as that one
  /// @param size  payload [bytes]
  Verdict send(Time now, std::size_t size) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }  ///< datagrams decided about

  /// From now on this path is the one in force, in the place of `before`, which is used no more. Datagrams go on being
  /// counted, order is kept across the change, what is held stays held, and what waits in the queue is served at the
  /// new rate. Models whose numbers stay the same go on as if nothing had happened. Takes no memory.
  /// @param at  the moment of the change
  void take_over(Path& before, Time at) noexcept TANDEM_REALTIME;

 private:
  static constexpr std::size_t kHeldMax = 64;
  struct Held {
    std::uint64_t index;
    Time nominal;         ///< when it would have come out
    Time limit;           ///< when it comes out at the latest
    std::uint32_t after;  ///< datagrams still to pass
  };

  void forget_late(Time now) noexcept;
  std::span<const Release> pass(Time at) noexcept;

  PathSpec spec_;
  OutageGate outages_;
  Loss loss_;
  LinkRate rate_;
  Duration floor_;
  TracePlayer trace_;
  BodyDelay body_;
  Regimes regimes_;
  Boundary boundary_;
  Stalls stalls_;
  Slots slots_;
  Order order_;
  ReorderSpec reorder_;
  DuplicateSpec duplicate_;
  std::uint64_t mtu_;  ///< payload
  double corrupted_;
  RandomKey corrupted_key_;
  RandomKey reorder_key_, duplicate_key_, copy_key_;
  std::uint64_t count_ = 0;
  Time last_in_{};
  Time last_out_{};
  std::size_t held_count_ = 0;
  std::array<Held, kHeldMax> held_{};
  std::array<Release, kHeldMax> released_{};
};

}  // namespace tandem::netsim
