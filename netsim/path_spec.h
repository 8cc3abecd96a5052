#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/body_spec.h"
#include "netsim/findings.h"
#include "netsim/loss_spec.h"

/// What one direction of a network does to datagrams, as plain numbers. The order of the members is the order in which
/// a datagram meets them (design notes, network 3.1). Everything is off by default; what is off costs nothing per packet.
namespace tandem::netsim {

/// Seen from a client: up is client to server.
enum class Direction : std::uint8_t { kUp, kDown };
inline constexpr std::size_t kDirections = 2;
[[nodiscard]] constexpr const char* name(Direction d) noexcept { return d == Direction::kUp ? "up" : "down"; }

/// The link is down for `length` from `start`, and again every `period`.
struct OutageSpec {
  enum class Mode : std::uint8_t {
    kDrop,  ///< what is sent meanwhile is lost
    kHold,  ///< what is sent meanwhile leaves, in order and at once, when the link is back
    kHoldLast,  ///< of what is sent meanwhile only the newest of every flow leaves when the link is back
  };
  /// Whose random moments and lengths they are. What is not drawn is common to all links that have it in their spec.
  enum class Scope : std::uint8_t {
    kLink,  ///< every link has its own
    kAll,   ///< all links of the network are down together
  };
  Duration start{};              ///< from Time{} [0, 30 d]
  Duration length{};             ///< (0, 1 h]
  Duration period{};             ///< 0: once; else longer than `length`
  Mode mode = Mode::kDrop;       ///< drop unless said otherwise
  std::uint64_t hold_bytes = 0;  ///< kHold: what does not fit any more is dropped; 0: no limit of its own
  /// Above 0: instead of `start` and `period` the outages begin as a Poisson process, so long apart on average, each
  /// uniform in [`length`, `length_max`] long; the same moments in both directions of a link. length_max <= 32
  /// mean_gap.
  Duration mean_gap{};
  /// The longest, if the lengths are drawn: of random outages, and of those with a `period` (below it), if not 0.
  Duration length_max{};  ///< 0 or [length, 1 h]
  Scope scope = Scope::kLink;
  Duration loss_at_start{};  ///< what is sent so soon after the start is lost, whatever the mode [0, length]

  friend bool operator==(const OutageSpec&, const OutageSpec&) = default;
};

/// Recorded capacity: so many opportunities of 1500 bytes in a millisecond, from the start again after `period`.
struct CapacityTrace {
  struct Entry {
    std::int64_t ms = 0;              ///< ascending from 0
    std::uint64_t opportunities = 1;  ///< at least 1
  };
  std::vector<Entry> entries = {};  ///< at least one
  Duration period{};                ///< whole milliseconds, after the last entry
};

/// Controlled delay [RFC 8289].
struct CoDelSpec {
  Duration target{5'000'000};      ///< (0, 10 s]
  Duration interval{100'000'000};  ///< above target, at most 60 s

  friend bool operator==(const CoDelSpec&, const CoDelSpec&) = default;
};

/// A sender that serves one datagram after the other at a fixed rate, and what may wait for it.
struct RateSpec {
  std::uint64_t bits_per_s = 0;             ///< 0: no rate, no queue; else [100, 1e12]
  std::uint32_t overhead_bytes = 28;        ///< added to every datagram on this link: IPv4 + UDP headers [0, 1000]
  std::uint64_t queue_bytes = 0;            ///< bytes not yet sent, the new datagram included; 0: no limit
  std::optional<Duration> queue_wait = {};  ///< longest wait before a datagram's first bit is sent [0, 1 h]
  /// The queue is shared with a TCP flow, which fills it to `competing_peak` of waiting and lets it drain, every
  /// `competing_period` [period above peak, at most 1 h; 0: nobody].
  Duration competing_peak{}, competing_period{};
  std::uint32_t queue_datagrams = 0;  ///< not yet sent, the new one included; 0: no limit; at most 65536
  std::optional<CoDelSpec> codel = {};
  std::shared_ptr<const CapacityTrace> trace = {};  ///< instead of bits_per_s; null: none
  /// What goes when something does not fit.
  enum class Drop : std::uint8_t {
    kTail,  ///< it
    kHead,  ///< what waits longest, until it fits; not what is being sent. Excludes CoDel and a competing flow
  } drop = Drop::kTail;
  bool recorded = false;  ///< plays a recording: one must be supplied as `trace` before the spec can be simulated
  [[nodiscard]] bool present() const noexcept { return bits_per_s != 0 || trace != nullptr; }

  friend bool operator==(const RateSpec&, const RateSpec&) = default;
};

/// A recorded delay as a function of time: steps, held until the next one, repeated with `period`.
struct DelayTrace {
  struct Step {
    Duration at{};     ///< from the start of the recording, ascending, first 0
    Duration delay{};  ///< [0, 60 s]
    bool lost = false;
  };
  std::vector<Step> steps = {};  ///< at least one
  Duration period{};             ///< longer than the last `at`
};

/// Stalls begin as a Poisson process; what would leave during one leaves at its end, at once. Length: Pareto.
struct StallSpec {
  double rate_per_s = 0;  ///< [0, 100]; rate times cap at most 32
  Duration length_min{};  ///< Pareto's x_m (0, 60 s]
  double alpha = 1.5;     ///< Pareto's exponent [0.5, 100]
  Duration cap{};         ///< longest stall [length_min, 60 s]

  friend bool operator==(const StallSpec&, const StallSpec&) = default;
};

enum class Order : std::uint8_t {
  kFifo,  ///< the time of arrival never decreases: jitter delays, it never overtakes
  kFree,  ///< every datagram has its own delay, as in netem: at 1 kHz even 1 ms of jitter reorders
};

/// Datagrams chosen to arrive after `displacement` later ones.
struct ReorderSpec {
  double probability = 0;            ///< [0, 1]
  std::uint32_t displacement = 3;    ///< [1, 1000] delivered datagrams
  Duration hold_limit{100'000'000};  ///< arrives this much late at the latest, when fewer follow (0, 60 s]

  friend bool operator==(const ReorderSpec&, const ReorderSpec&) = default;
};

/// Datagrams that arrive twice; what is lost has no copy, and a copy is never earlier than its original.
struct DuplicateSpec {
  double probability = 0;         ///< [0, 1]
  Duration delay_max{1'000'000};  ///< the copy comes uniform in [0, delay_max] later [0, 60 s]

  friend bool operator==(const DuplicateSpec&, const DuplicateSpec&) = default;
};

/// Damage under way, after the datagram used the queue. Of a fragmented one every fragment may be hit.
struct CorruptionSpec {
  enum class Mode : std::uint8_t {
    kChecksum,  ///< the checksum of UDP tells, and the datagram is dropped: what happens to nearly all
    kBitFlips,  ///< `bits` different bits of the payload are wrong, at drawn places
    kTruncate,  ///< the payload ends early: its length is drawn, uniform in [0, size - 1]
  };
  double probability = 0;  ///< [0, 1]
  Mode mode = Mode::kChecksum;
  std::uint32_t bits = 1;  ///< kBitFlips [1, 64]

  friend bool operator==(const CorruptionSpec&, const CorruptionSpec&) = default;
};

/// What a link does with datagrams that are longer than it can carry, overhead of the rate included.
struct MtuSpec {
  enum class Above : std::uint8_t {
    kDrop,
    /// As many fragments as needed, each with the overhead: they meet loss, queue and delay one by one; all must arrive,
    /// and the datagram comes out with the last. In a queue with Drop::kHead they stay together.
    kFragment,
  };
  std::uint32_t bytes = 0;  ///< 0: no limit; else above the overhead, kFragment: by 8 or more
  Above above = Above::kDrop;

  friend bool operator==(const MtuSpec&, const MtuSpec&) = default;
};

/// One direction of one link.
struct PathSpec {
  std::vector<OutageSpec> outages = {};  ///< at most 64
  LossSpec loss = {};
  RateSpec rate = {};
  Duration floor{};                              ///< propagation: no datagram is faster [0, 60 s]
  std::shared_ptr<const DelayTrace> trace = {};  ///< recorded delay added to the floor; null: none
  BodySpec body = {};
  std::vector<RegimeSpec> regimes = {};  ///< none, or [2, 16]
  BoundarySpec boundary = {};
  StallSpec stall = {};
  SlotsSpec slots = {};  ///< needs Order::kFifo
  Order order = Order::kFifo;
  ReorderSpec reorder = {};
  DuplicateSpec duplicate = {};
  CorruptionSpec corruption = {};
  MtuSpec mtu = {};

  friend bool operator==(const PathSpec&, const PathSpec&) = default;
};

/// Both directions of one client's link, or of the one that all clients share.
struct LinkSpec {
  PathSpec up = {}, down = {};
  /// All clients with this spec are on one link: one access point, one uplink. Queue, order, outages, stalls and every
  /// other process in time are common; what is drawn or counted per datagram is each client's own.
  bool shared = false;

  [[nodiscard]] const PathSpec& operator[](Direction d) const noexcept { return d == Direction::kUp ? up : down; }
  [[nodiscard]] PathSpec& operator[](Direction d) noexcept { return d == Direction::kUp ? up : down; }
  friend bool operator==(const LinkSpec&, const LinkSpec&) = default;
};

/// All mistakes; empty: the spec can be simulated.
[[nodiscard]] std::vector<SpecProblem> problems(const PathSpec& spec);

/// Whether the fate of a datagram may be known only later than when it is sent: see Path.
[[nodiscard]] bool defers(const PathSpec& spec) noexcept;
/// Whether later datagrams can change when one comes out, or whether it does.
[[nodiscard]] bool waits_for_others(const PathSpec& spec) noexcept;

/// The longest delay the spec can add, without the queue of its rate and without the order policy. For sizing stores.
[[nodiscard]] Duration delay_max(const PathSpec& spec) noexcept;

/// The network of the shared command line options, the same in both directions: `delay` is the floor, `jitter` is
/// uniform in [0, jitter] and added for every datagram alone, order fifo.
struct SimpleNetwork {
  Duration delay{};      ///< [0, 60 s]
  Duration jitter{};     ///< [0, 60 s]
  double loss = 0;       ///< probability [0, 1]
  double duplicate = 0;  ///< probability [0, 1]
  double reorder = 0;    ///< probability of arriving after three later datagrams [0, 1]
  std::vector<OutageSpec> outages = {};
};
[[nodiscard]] LinkSpec link_from(const SimpleNetwork& numbers);

}  // namespace tandem::netsim
