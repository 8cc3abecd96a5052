#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/body_spec.h"
#include "netsim/models/loss_spec.h"
#include "netsim/models/shared_recording.h"
#include "netsim/models/spec_errors.h"

/// Specification of one direction of a link. The order of the members is the order in which they affect a datagram. All
/// models are off by default; a disabled model costs nothing per packet.
namespace tandem::netsim {

/// Direction from the client's point of view: up is client to server.
enum class Direction : std::uint8_t { kUp, kDown };
/// Number of directions of a link.
inline constexpr std::size_t kDirections = 2;
/// Returns `up` or `down`.
[[nodiscard]] constexpr const char* name(Direction d) noexcept { return d == Direction::kUp ? "up" : "down"; }

/// Outage: the link is down for `length` from `start`, and again every `period`.
struct OutageSpec {
  /// Fate of datagrams sent during an outage.
  enum class Mode : std::uint8_t {
    kDrop,      ///< datagrams sent during the outage are lost
    kHold,      ///< datagrams sent during the outage leave in order, all at once, when it ends
    kHoldLast,  ///< only the newest datagram of each flow is kept; it leaves when the outage ends
  };
  /// Range of links that share the random times and lengths. Parts that are not random are equal on all links with this
  /// spec.
  enum class Scope : std::uint8_t {
    kLink,  ///< every link has its own random outages
    kAll,   ///< all links of the network are down simultaneously
  };
  Duration start{};              ///< from Time{} [0, 30 d]
  Duration length{};             ///< (0, 1 h]
  Duration period{};             ///< 0: one outage; else longer than `length`
  Mode mode = Mode::kDrop;       ///< fate of datagrams sent during the outage
  std::uint64_t hold_bytes = 0;  ///< kHold: datagrams beyond this many bytes are dropped; 0: no limit
  /// Above 0: outages begin as a Poisson process with this mean gap, instead of at `start` and `period`. Each lasts
  /// uniformly [`length`, `length_max`], at the same times in both directions of a link. length_max <= 32 mean_gap.
  Duration mean_gap{};
  /// Upper bound of random lengths: required for random outages; with a `period`, lengths are random if it is not 0.
  Duration length_max{};       ///< 0 or [length, 1 h]; below `period`
  Scope scope = Scope::kLink;  ///< links that share the random times
  Duration loss_at_start{};    ///< datagrams sent within this time after the start are lost in every mode [0, length]

  friend bool operator==(const OutageSpec&, const OutageSpec&) = default;
};

/// Recorded capacity: number of opportunities of 1500 bytes per millisecond. The recording repeats after `period`.
struct CapacityTrace {
  /// Opportunities of one millisecond.
  struct Entry {
    std::int64_t ms = 0;              ///< ascending from 0
    std::uint64_t opportunities = 1;  ///< at least 1

    friend bool operator==(const Entry&, const Entry&) = default;
  };
  std::vector<Entry> entries = {};  ///< at least one
  Duration period{};                ///< whole milliseconds, later than the last entry

  friend bool operator==(const CapacityTrace&, const CapacityTrace&) = default;
};

/// Controlled delay [RFC 8289].
struct CoDelSpec {
  Duration target{5'000'000};      ///< (0, 10 s]
  Duration interval{100'000'000};  ///< above target, at most 60 s

  friend bool operator==(const CoDelSpec&, const CoDelSpec&) = default;
};

/// Sender that transmits one datagram after another at a fixed rate, and the limits of its queue.
struct RateSpec {
  std::uint64_t bits_per_s = 0;       ///< 0: no rate, no queue; else [100, 1e12]
  std::uint32_t overhead_bytes = 28;  ///< added to every datagram on this link; default: IPv4 + UDP headers [0, 1000]
  std::uint64_t queue_bytes = 0;      ///< limit of unsent bytes, the new datagram included; 0: no limit
  std::optional<Duration> queue_wait = {};  ///< longest wait before a datagram's first bit is sent [0, 1 h]
  /// A TCP flow shares the queue: in every `competing_period` it fills the queue to a wait of `competing_peak` and then
  /// lets it drain. The period is above the peak and at most 1 h; 0: no competing flow.
  Duration competing_peak{},            ///< longest wait due to a competing TCP flow
      competing_period{};               ///< its period
  std::uint32_t queue_datagrams = 0;    ///< limit of unsent datagrams, the new one included; 0: no limit; at most 65536
  std::optional<CoDelSpec> codel = {};  ///< empty: no controlled delay
  SharedRecording<CapacityTrace> trace = {};  ///< replaces bits_per_s; null: none
  /// Datagrams to drop when the queue is full.
  enum class Drop : std::uint8_t {
    kTail,  ///< the new datagram
    kHead,  ///< the longest-waiting datagrams, until the new one fits; never the one being sent. Excludes CoDel and a
            ///< competing flow
  } drop = Drop::kTail;   ///< datagrams to drop when the queue is full
  bool recorded = false;  ///< plays a recording: `trace` must be set before the spec can be simulated
  /// Returns whether the link has a rate.
  [[nodiscard]] bool present() const noexcept { return bits_per_s != 0 || trace != nullptr; }

  friend bool operator==(const RateSpec&, const RateSpec&) = default;
};

/// Recorded delay as a function of time. Each step holds until the next one; the recording repeats with `period`.
struct DelayTrace {
  /// Delay from one time on.
  struct Step {
    Duration at{};      ///< time from the start of the recording, ascending, first 0
    Duration delay{};   ///< [0, 60 s]
    bool lost = false;  ///< datagrams of this step are lost

    friend bool operator==(const Step&, const Step&) = default;
  };
  std::vector<Step> steps = {};  ///< at least one
  Duration period{};             ///< longer than the last `at`

  friend bool operator==(const DelayTrace&, const DelayTrace&) = default;
};

/// Stalls that begin as a Poisson process. Datagrams due during a stall leave together at its end. Lengths are Pareto
/// distributed.
struct StallSpec {
  double rate_per_s = 0;  ///< [0, 100]; rate times cap at most 32
  Duration length_min{};  ///< Pareto scale x_m (0, 60 s]
  double alpha = 1.5;     ///< Pareto exponent [0.5, 100]
  Duration cap{};         ///< longest stall [length_min, 60 s]

  friend bool operator==(const StallSpec&, const StallSpec&) = default;
};

/// Order of arrivals.
enum class ArrivalOrder : std::uint8_t {
  kFifo,  ///< arrival times never decrease: jitter delays datagrams but never reorders them
  kFree,  ///< every datagram has an independent delay, as in netem; at 1 kHz even 1 ms of jitter reorders
};

/// Reordering: selected datagrams arrive after `displacement` later ones.
struct ReorderSpec {
  double probability = 0;            ///< [0, 1]
  std::uint32_t displacement = 3;    ///< [1, 1000] delivered datagrams
  Duration hold_limit{100'000'000};  ///< maximum extra delay if fewer datagrams follow (0, 60 s]

  friend bool operator==(const ReorderSpec&, const ReorderSpec&) = default;
};

/// Duplication. A lost datagram has no copy, and a copy never arrives before its original.
struct DuplicateSpec {
  double probability = 0;         ///< [0, 1]
  Duration delay_max{1'000'000};  ///< delay of the copy after the original, uniform in [0, delay_max] [0, 60 s]

  friend bool operator==(const DuplicateSpec&, const DuplicateSpec&) = default;
};

/// Corruption on the link; the datagram still uses the queue. Each fragment of a fragmented datagram can be corrupted.
struct CorruptionSpec {
  /// Effect of a corruption.
  enum class Mode : std::uint8_t {
    kChecksum,  ///< the UDP checksum detects the error and the receiver drops the datagram, the usual case
    kBitFlips,  ///< `bits` distinct bits of the payload are inverted, at random positions
    kTruncate,  ///< the payload is truncated to a length uniform in [0, size - 1]
  };
  double probability = 0;       ///< [0, 1]
  Mode mode = Mode::kChecksum;  ///< effect
  std::uint32_t bits = 1;       ///< kBitFlips [1, 64]

  friend bool operator==(const CorruptionSpec&, const CorruptionSpec&) = default;
};

/// Treatment of datagrams longer than the link's MTU. The size includes the overhead of the rate.
struct MtuSpec {
  /// Fate of longer datagrams.
  enum class Above : std::uint8_t {
    kDrop,
    /// Splits the datagram into as many fragments as needed, each with the overhead. Loss, queue and delay apply to
    /// each fragment. The datagram arrives with its last fragment, and only if all arrive. A queue with Drop::kHead
    /// keeps fragments together.
    kFragment,
  };
  std::uint32_t bytes = 0;     ///< 0: no limit; else above the overhead, with kFragment by at least 8
  Above above = Above::kDrop;  ///< fate of longer datagrams

  friend bool operator==(const MtuSpec&, const MtuSpec&) = default;
};

/// One direction of one link.
struct PathSpec {
  std::vector<OutageSpec> outages = {};      ///< at most 64
  LossSpec loss = {};                        ///< random loss
  RateSpec rate = {};                        ///< rate and queue
  Duration floor{};                          ///< propagation delay, the minimum of every datagram [0, 60 s]
  SharedRecording<DelayTrace> trace = {};    ///< recorded delay added to the floor; null: none
  BodySpec body = {};                        ///< random delay added to the floor
  std::vector<RegimeSpec> regimes = {};      ///< empty, or 2 to 16 regimes
  BoundarySpec boundary = {};                ///< transmission at periodic times only
  StallSpec stall = {};                      ///< random stalls
  SlotsSpec slots = {};                      ///< requires ArrivalOrder::kFifo
  ArrivalOrder order = ArrivalOrder::kFifo;  ///< order of arrivals
  ReorderSpec reorder = {};                  ///< reordering
  DuplicateSpec duplicate = {};              ///< duplication
  CorruptionSpec corruption = {};            ///< corruption
  MtuSpec mtu = {};                          ///< longest datagram

  friend bool operator==(const PathSpec&, const PathSpec&) = default;
};

/// Both directions of one client's link, or of a link that all clients share.
struct LinkSpec {
  PathSpec up = {},  ///< client to server
      down = {};     ///< server to client
  /// True: all clients with this spec use one link, for example one access point or uplink. Queue, order, outages,
  /// stalls and every other time process are common. Per-datagram draws and counts are separate for each client.
  bool shared = false;

  /// Returns one direction.
  [[nodiscard]] const PathSpec& operator[](Direction d) const noexcept { return d == Direction::kUp ? up : down; }
  /// Returns one direction.
  [[nodiscard]] PathSpec& operator[](Direction d) noexcept { return d == Direction::kUp ? up : down; }
  friend bool operator==(const LinkSpec&, const LinkSpec&) = default;
};

/// Returns all errors of the spec; empty if the spec is valid.
[[nodiscard]] std::vector<SpecError> problems(const PathSpec& spec);

/// Returns whether decisions may become final after sending, see Path.
[[nodiscard]] bool defers(const PathSpec& spec) noexcept;
/// Returns whether later datagrams can change the arrival time or the decision of earlier ones.
[[nodiscard]] bool waits_for_others(const PathSpec& spec) noexcept;

/// Returns the maximum delay of the spec, excluding the queue of its rate and the order policy. Used to size stores.
[[nodiscard]] Duration delay_max(const PathSpec& spec) noexcept;

/// Network of the shared command-line options, equal in both directions. `delay` is the floor; `jitter` adds an
/// independent uniform delay in [0, jitter] to every datagram. The order is fifo.
struct SimpleNetwork {
  Duration delay{};                      ///< [0, 60 s]
  Duration jitter{};                     ///< [0, 60 s]
  double loss = 0;                       ///< probability [0, 1]
  double duplicate = 0;                  ///< probability [0, 1]
  double reorder = 0;                    ///< probability of arriving after three later datagrams [0, 1]
  std::vector<OutageSpec> outages = {};  ///< of both directions
};
/// Returns the link of a simple network.
[[nodiscard]] LinkSpec link_from(const SimpleNetwork& numbers);

}  // namespace tandem::netsim
