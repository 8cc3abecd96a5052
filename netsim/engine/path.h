#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/engine/path_decision.h"
#include "netsim/models/body_delay.h"
#include "netsim/models/delay_models.h"
#include "netsim/models/delay_trace_player.h"
#include "netsim/models/head_drop.h"
#include "netsim/models/link_rate.h"
#include "netsim/models/loss.h"
#include "netsim/models/outages.h"
#include "netsim/models/path_spec.h"
#include "netsim/models/stalls.h"

namespace tandem::netsim {

/// One direction of one link. It decides for every datagram whether and when it arrives. It stores no bytes, reads no
/// clock and allocates nothing after construction. Decisions are a pure function of (spec, keys, flows, times and
/// sizes).
///
/// Randomness is drawn per datagram index (loss, uncorrelated body, duplicate, reorder) or per time slot (bad periods,
/// correlated body, stalls). Each purpose has its own key, so that no decision affects another.
/// Identity: with kFifo and without reordering, `at` never decreases; `at >= sent + floor` always.
///
/// Several flows (clients) may share the link. Time, queue, outages, order and all time processes are common.
/// Per-datagram counts and draws are separate for each flow, so that other flows do not affect its draws.
///
/// A later datagram can change the decision on an earlier one in a drop-head queue, or in an outage that keeps the
/// newest. Such a decision is kWaiting, and `resolve` returns the final one.
class Path {
 public:
  /// Keys of the randomness of a path.
  struct Keys {
    RandomKey path;     ///< this direction of this link
    RandomKey link;     ///< both directions: times of the link's random outages
    RandomKey network;  ///< all links: times of the common random outages
  };
  /// Returns the keys of a link with one client. `link` is the caller's name of the link (seat index, client number).
  [[nodiscard]] static Keys keys_for(std::uint64_t seed, std::uint64_t link, Direction direction) noexcept {
    return {key_for(seed, link, direction), key_for(seed, link), RandomKey{seed}.derive(kNetworkName)};
  }
  /// Returns the keys of a shared link. `number` is in [0, 2^32).
  [[nodiscard]] static Keys shared_keys(std::uint64_t seed, std::uint32_t number, Direction direction) noexcept {
    return keys_for(seed, kSharedName + number, direction);
  }
  [[nodiscard]] static RandomKey key_for(std::uint64_t seed, std::uint64_t link, Direction direction) noexcept {
    return RandomKey{seed}.derive(link).derive(static_cast<std::uint64_t>(direction));
  }
  [[nodiscard]] static RandomKey key_for(std::uint64_t seed, std::uint64_t link) noexcept {
    return RandomKey{seed}.derive(link).derive(kDirections);
  }

  /// Path with one flow, number 0 and name 0.
  /// @throws std::invalid_argument listing all errors of the spec.
  Path(const PathSpec& spec, const Keys& keys);
  Path(const PathSpec& spec, RandomKey key) : Path(spec, Keys{key, key, key}) {}

  /// Creates a flow, or resets it for another client. Setup only.
  /// @param flow  [0, flows()]
  /// @param name  key of the flow's draws; distinct names below 2^23 never share draws
  void set_flow(std::uint32_t flow, std::uint64_t name);
  [[nodiscard]] std::uint32_t flows() const noexcept { return static_cast<std::uint32_t>(flows_.size()); }

  /// Returns the decision on one datagram. If `defers()`, call `resolve` until it returns empty before and after this
  /// call.
  /// @param now   time of sending; a time before an earlier call's is replaced by that one
  /// @param flow  below flows()
  /// @param size  payload [bytes]
  PathDecision send(Time now, std::uint32_t flow, std::size_t size) noexcept TANDEM_REALTIME;
  PathDecision send(Time now, std::size_t size) noexcept TANDEM_REALTIME { return send(now, 0, size); }

  /// Returns whether decisions can be kWaiting.
  [[nodiscard]] bool defers() const noexcept { return head_.has_value() || keeps_newest_ || !newest_.empty(); }
  /// Sets the caller's storage location of the datagram just sent, whose decision was kWaiting.
  void set_ticket(std::uint32_t flow, std::uint32_t ticket) noexcept TANDEM_REALTIME;
  /// Final decision on a datagram that waited.
  struct Resolved {
    std::uint32_t flow = 0;  ///< kNoFlow: the client left; only the ticket is valid
    std::uint32_t ticket = InTransit::kNoTicket;
    PathDecision decision;  ///< never kWaiting
  };
  static constexpr std::uint32_t kNoFlow = ~std::uint32_t{0};
  /// Returns the next waiting datagram whose decision is final at `now`; empty if there is none.
  std::optional<Resolved> resolve(Time now) noexcept TANDEM_REALTIME;
  /// Returns the next time at which `resolve` has a result if nothing is sent before.
  [[nodiscard]] std::optional<Time> next_resolve() noexcept;
  /// Removes the flow of a client that left. Its waiting datagrams stay in the queue, as those of kNoFlow.
  void remove_flow(std::uint32_t flow) noexcept TANDEM_REALTIME;

  /// Returns the next datagram waiting in the queue, with the decision of this path. Returns empty if `next` has an
  /// equal queue and takes it over.
  std::optional<Resolved> flush(const Path& next) noexcept TANDEM_REALTIME;
  /// Takes over from `before`, which is not used afterwards. Datagram counts continue, order is kept across the change,
  /// and held datagrams stay held. Queued datagrams are served at the new rate; call `flush` on the old path first.
  /// Models with equal parameters continue without interruption. Allocates nothing.
  /// @param before  path with the same number of flows
  /// @param at      time of the change
  void replace(Path& before, Time at) noexcept TANDEM_REALTIME;

  /// Returns the wait in the rate's queue of a datagram that arrives at `now`, until its first bit is sent. 0 without a
  /// rate. Affects no decision.
  [[nodiscard]] Duration queue_wait(Time now) noexcept;

  /// Returns the number of datagrams sent into a flow, decided or waiting.
  [[nodiscard]] std::uint64_t count(std::uint32_t flow = 0) const noexcept { return flows_[flow].count; }

 private:
  static constexpr std::size_t kHeldMax = 64;
  static constexpr std::uint64_t kNetworkName = 0x616c6c206c696e6b;  ///< distinct from client numbers
  static constexpr std::uint64_t kSharedName = 0x7368617265640000;
  struct Held {
    std::uint64_t index;
    Time nominal;         ///< arrival time without reordering
    Time limit;           ///< latest arrival time
    std::uint32_t after;  ///< number of datagrams that still have to pass
  };
  struct Flow {
    std::uint64_t salt;  ///< combined with the index of every per-datagram draw
    Loss loss;
    std::uint64_t count = 0;    ///< number of datagrams
    std::uint64_t packets = 0;  ///< number of datagrams, with each fragment counted
    std::size_t held_count = 0;
    std::array<Held, kHeldMax> held{};
  };
  /// Newest datagram of a flow, held until the end of an outage.
  struct Newest {
    InTransit datagram;
    Time until;
  };

  void keep_newest(const InTransit& datagram, Time until) noexcept;
  Resolved decided(const HeadDropQueue::Decided& left) noexcept;
  // These return the outcome and set the arrival time and the rest of the decision.
  Outcome enter(Flow& from, InTransit& datagram, PathDecision& decision) noexcept;
  Outcome reach_queue(const InTransit& datagram, Time at, PathDecision& decision) noexcept;
  Outcome send_whole(Flow& from, const InTransit& datagram, Time at, PathDecision& decision) noexcept;
  Outcome send_in_pieces(Flow& from, const InTransit& datagram, Time at, PathDecision& decision) noexcept;
  Outcome leave_queue(Flow& from, const InTransit& datagram, Time sent, PathDecision& decision) noexcept;
  Outcome arrive(Flow& from, std::size_t size, bool hit, PathDecision& decision) noexcept;
  [[nodiscard]] bool is_corrupted(const Flow& from, std::uint64_t packet, std::uint32_t pieces) const noexcept;
  std::optional<Time> travel(Flow& from, std::uint64_t packet, std::size_t size, Duration recorded, Time sent) noexcept;

  static void remove_expired(Flow& flow, Time now) noexcept;
  std::span<const Release> pass(Flow& flow, Time at) noexcept;

  PathSpec spec_;
  RandomKey loss_key_;
  OutageGate outages_;
  LinkRate rate_;
  DelayTracePlayer trace_;
  BodyDelay body_;
  Regimes regimes_;
  Boundary boundary_;
  Stalls stalls_;
  Slots slots_;
  std::uint64_t payload_max_;  ///< largest payload that fits the MTU unfragmented
  RandomKey corruption_key_, place_key_;
  RandomKey reorder_key_, duplicate_key_, copy_key_;
  Time last_in_{};
  Time last_out_{};
  std::vector<Flow> flows_;
  std::optional<HeadDropQueue> head_;
  bool keeps_newest_ = false;
  bool plain_queue_ = true;           ///< nothing between the outage gate and the rate
  bool plain_end_ = true;             ///< no corruption, duplication or reordering
  std::vector<Newest> newest_;        ///< at most one per flow, in the order of sending
  std::optional<Resolved> replaced_;  ///< datagram replaced by the newest one sent
  std::array<Release, kHeldMax> released_{};
};

}  // namespace tandem::netsim
