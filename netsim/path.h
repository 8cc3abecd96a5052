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
#include "netsim/body_delay.h"
#include "netsim/delay_models.h"
#include "netsim/head_drop.h"
#include "netsim/link_rate.h"
#include "netsim/loss.h"
#include "netsim/outages.h"
#include "netsim/path_spec.h"
#include "netsim/stalls.h"
#include "netsim/trace_player.h"
#include "netsim/verdict.h"

namespace tandem::netsim {

/// One direction of one link: tells, for every datagram, whether and when it comes out. It keeps no bytes, reads no
/// clock and takes no memory after construction; decisions are a pure function of (spec, keys, flows, times and sizes).
///
/// Randomness is drawn per datagram index (loss, body without correlation, duplicate, reorder) or per time slot (bad
/// periods, correlated body, stalls), each purpose with a key of its own, so that no decision moves another.
/// Identity: kFifo and no reordering give `at` that never decreases; `at >= sent + floor` always.
///
/// Several flows (clients) may share the link. Common: time, queue, outages, order and all processes in time. Each
/// flow's own: what is counted or drawn per datagram, so that another flow moves none of its draws.
///
/// Where a later datagram can still change an earlier one's fate (a queue that drops at its head, an outage that keeps
/// the newest), the verdict is kWaiting, and `settle` tells the rest.
class Path {
 public:
  /// What the randomness of a path hangs on.
  struct Keys {
    RandomKey path;     ///< this direction of this link
    RandomKey link;     ///< both directions: the moments of its random outages
    RandomKey network;  ///< all links: the moments of random outages that all have together
  };
  /// Of a link with one client. `link` is the caller's name for it (seat index, client number).
  [[nodiscard]] static Keys keys_for(std::uint64_t seed, std::uint64_t link, Direction direction) noexcept {
    return {key_for(seed, link, direction), key_for(seed, link), RandomKey{seed}.derive(kNetworkName)};
  }
  /// Of a link that clients share. `number` from 0, below 2^32.
  [[nodiscard]] static Keys shared_keys(std::uint64_t seed, std::uint32_t number, Direction direction) noexcept {
    return keys_for(seed, kSharedName + number, direction);
  }
  [[nodiscard]] static RandomKey key_for(std::uint64_t seed, std::uint64_t link, Direction direction) noexcept {
    return RandomKey{seed}.derive(link).derive(static_cast<std::uint64_t>(direction));
  }
  [[nodiscard]] static RandomKey key_for(std::uint64_t seed, std::uint64_t link) noexcept {
    return RandomKey{seed}.derive(link).derive(kDirections);
  }

  /// With one flow, number 0, of name 0.
  /// @throws std::invalid_argument listing all problems of the spec.
  Path(const PathSpec& spec, const Keys& keys);
  Path(const PathSpec& spec, RandomKey key) : Path(spec, Keys{key, key, key}) {}

  /// Makes a flow, or makes it anew for another client; setup only.
  /// @param flow  [0, flows()]
  /// @param name  what its draws hang on; names below 2^23 never draw alike
  void set_flow(std::uint32_t flow, std::uint64_t name);
  [[nodiscard]] std::uint32_t flows() const noexcept { return static_cast<std::uint32_t>(flows_.size()); }

  /// Decides about one datagram. If the path `defers`: call `settle` until empty before it and after it.
  /// @param now   time of sending; a time before that of an earlier call counts as that one
  /// @param flow  below flows()
  /// @param size  payload [bytes]
  Verdict send(Time now, std::uint32_t flow, std::size_t size) noexcept TANDEM_REALTIME;
  Verdict send(Time now, std::size_t size) noexcept TANDEM_REALTIME { return send(now, 0, size); }

  /// Whether kWaiting can happen at all.
  [[nodiscard]] bool defers() const noexcept { return head_.has_value() || keeps_newest_ || !newest_.empty(); }
  /// Remembers where the caller keeps the datagram just sent, of which `send` said kWaiting.
  void set_ticket(std::uint32_t flow, std::uint32_t ticket) noexcept TANDEM_REALTIME;
  struct Settled {
    std::uint32_t flow = 0;  ///< kNobody: of a client that left; only its ticket is of use
    std::uint32_t ticket = InTransit::kNoTicket;
    Verdict verdict;  ///< never kWaiting
  };
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};
  /// A datagram that waited and is decided about at `now`.
  std::optional<Settled> settle(Time now) noexcept TANDEM_REALTIME;
  /// When `settle` has something to say, if nothing is sent before.
  [[nodiscard]] std::optional<Time> next_settle() noexcept;
  /// The client of a flow left: what waits of it stays in the queue, and is nobody's.
  void forget(std::uint32_t flow) noexcept TANDEM_REALTIME;

  /// Everything that waits in the queue, as this path would serve it, unless `next` has the same queue and takes it over.
  std::optional<Settled> drain(const Path& next) noexcept TANDEM_REALTIME;
  /// From now on this path is the one in force, in the place of `before`, which is used no more. Datagrams go on being
  /// counted, order is kept across the change, what is held stays held, and what waits in the queue is served at the
  /// new rate; call `drain` of the old one before. Models whose numbers stay the same go on as if nothing
  /// had happened. Takes no memory.
  /// @param before  with as many flows
  /// @param at      the moment of the change
  void take_over(Path& before, Time at) noexcept TANDEM_REALTIME;

  /// How long a datagram that comes now would wait in the queue of the rate before its first bit is sent; 0 without a rate.
  /// Moves no decision.
  [[nodiscard]] Duration queue_wait(Time now) noexcept;

  /// Datagrams decided about or waiting.
  [[nodiscard]] std::uint64_t count(std::uint32_t flow = 0) const noexcept { return flows_[flow].count; }

 private:
  static constexpr std::size_t kHeldMax = 64;
  static constexpr std::uint64_t kNetworkName = 0x616c6c206c696e6b;  ///< far from the numbers of clients
  static constexpr std::uint64_t kSharedName = 0x7368617265640000;
  struct Held {
    std::uint64_t index;
    Time nominal;         ///< when it would have come out
    Time limit;           ///< when it comes out at the latest
    std::uint32_t after;  ///< datagrams still to pass
  };
  struct Flow {
    std::uint64_t salt;  ///< put on top of an index where a number is drawn for it
    Loss loss;
    std::uint64_t count = 0;    ///< datagrams
    std::uint64_t packets = 0;  ///< the same with every fragment counted
    std::size_t held_count = 0;
    std::array<Held, kHeldMax> held{};
  };
  /// A newest one that the end of an outage lets go.
  struct Newest {
    InTransit datagram;
    Time until;
  };

  void keep_newest(const InTransit& datagram, Time until) noexcept;
  Settled decided(const HeadDropQueue::Left& left) noexcept;
  void reach_queue(const InTransit& datagram, Time at, Verdict& verdict) noexcept;
  void reach_queue_in_pieces(const InTransit& datagram, Time at, Verdict& verdict) noexcept;
  void leave_queue(Flow& from, std::uint64_t packet, std::size_t size, Duration recorded, Time sent,
                   bool hit, Verdict& verdict) noexcept;
  [[nodiscard]] bool damaged(const Flow& from, std::uint64_t packet, std::uint32_t pieces) const noexcept;
  std::optional<Time> travel(Flow& from, std::uint64_t packet, std::size_t size, Duration recorded, Time sent) noexcept;
  void arrive(Flow& from, std::size_t size, bool hit, Verdict& verdict) noexcept;

  static void forget_late(Flow& flow, Time now) noexcept;
  std::span<const Release> pass(Flow& flow, Time at) noexcept;

  PathSpec spec_;
  RandomKey loss_key_;
  OutageGate outages_;
  LinkRate rate_;
  TracePlayer trace_;
  BodyDelay body_;
  Regimes regimes_;
  Boundary boundary_;
  Stalls stalls_;
  Slots slots_;
  std::uint64_t payload_max_;  ///< that the MTU lets through in one piece
  RandomKey damage_key_, place_key_;
  RandomKey reorder_key_, duplicate_key_, copy_key_;
  Time last_in_{};
  Time last_out_{};
  std::vector<Flow> flows_;
  std::optional<HeadDropQueue> head_;
  bool keeps_newest_ = false;
  bool plain_queue_ = true;  ///< nothing between the gate and the rate
  bool plain_end_ = true;    ///< neither damage nor copies nor reordering
  std::vector<Newest> newest_;     ///< one per flow at most, in the order of sending
  std::optional<Settled> replaced_;  ///< by the newest datagram sent
  std::array<Release, kHeldMax> released_{};
};

}  // namespace tandem::netsim
