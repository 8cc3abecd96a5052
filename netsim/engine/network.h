#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/addresses.h"
#include "netsim/engine/path_counters.h"
#include "netsim/engine/schedule.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

class DecisionSink;
class LinkMonitor;
class LinkTimeline;
class Replay;

/// Delivered datagram.
struct Delivery {
  std::uint32_t link = 0;                ///< number of the link
  Direction direction = Direction::kUp;  ///< direction on the link
  Time sent;                             ///< time of sending
  Time at;                               ///< time of arrival
  std::uint64_t index = 0;               ///< index on its path; a copy has the index of its original
  std::size_t size = 0;                  ///< full size [bytes], also if a smaller buffer truncated the data
  std::uint32_t address = 0;             ///< the client's address number; up: sender, down: destination
};

/// Virtual network of links. Datagrams enter with `send` and come out of `poll` when the caller's time reaches their
/// arrival time. `add_link` and `add_replay` allocate all memory; `send` and `poll` allocate none, also when a link
/// changes. Equal seed, specs and calls give equal deliveries.
class Network {
 public:
  /// Starts without links. @param seed  of all random draws
  explicit Network(std::uint64_t seed) noexcept;
  ~Network();

  /// Adds a client's link, with the link's number as key of its randomness. Setup only.
  /// @return number of the link: 0, 1, ...
  /// @throws std::invalid_argument listing all errors of the spec.
  std::uint32_t add_link(const LinkSpec& spec);
  /// The same with another key.
  /// @param spec  both directions of the link
  /// @param name  key of the link's randomness, so that other links do not affect it
  std::uint32_t add_link(const LinkSpec& spec, std::uint64_t name);
  /// The same with scheduled changes. Each takes effect at its own time, independent of the traffic.
  std::uint32_t add_link(const LinkSchedule& schedule, std::uint64_t name);
  /// Adds a shared link. Setup only. Clients whose specs set `shared` do not need this call: `add_link` puts clients
  /// with equal specs and changes on one link.
  /// @return number among the shared links: 0, 1, ...; the key of its time processes
  std::uint32_t add_shared(const LinkSchedule& schedule);
  /// The same without scheduled changes.
  std::uint32_t add_shared(const LinkSpec& spec) { return add_shared(LinkSchedule{.initial = spec}); }
  /// Adds a client to a shared link.
  /// @param shared   number of the shared link
  /// @param name     key of the client's per-datagram draws
  /// @param rebinds  changes of the client's address
  /// @return number of the link, as from `add_link`
  std::uint32_t add_flow(std::uint32_t shared, std::uint64_t name,
                         const std::vector<LinkSchedule::AddressChange>& rebinds = {});
  /// Adds a link that replays the recording of `flow`. Seed and name have no effect.
  std::uint32_t add_replay(std::shared_ptr<const Replay> replay, std::uint32_t flow);

  /// Sends every later decision to `sink`; null: to none. Setup only. The sink must outlive the network.
  void log_to(DecisionSink* sink) noexcept;
  /// Returns the earliest entry time of any datagram in flight; empty if there is none. All earlier datagrams are in
  /// the log.
  [[nodiscard]] std::optional<Time> oldest_in_flight() const noexcept;
  /// Logs all datagrams in flight. This completes a log.
  void log_in_flight() const noexcept;

  /// Returns the number of clients, each on its own link or on a shared one.
  [[nodiscard]] std::size_t links() const noexcept { return addresses_.size(); }

  /// Sends one datagram of at most kSlotBytes. Up: from the client's address at `now`. Down: to the newest address
  /// among all delivered datagrams.
  /// @return outcome; kOverflow for an unknown link
  Outcome send(Time now, std::uint32_t link, Direction direction,
               std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// The same down to a given address of the client. The datagram is dropped if that address is dead at its arrival.
  Outcome send_to(Time now, std::uint32_t link, std::uint32_t address,
                  std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// Changes the client's address at `now`, in addition to the changes of its schedule.
  /// @return false: unknown link, or the client already has Addresses::kMax addresses
  bool rebind(Time now, std::uint32_t link, const Rebind& rebind) noexcept TANDEM_REALTIME;

  /// Copies the next datagram of this link and direction due at `now` into `buffer`. Call until it returns empty.
  /// Without delay a datagram is due at its time of sending. Equal times: order of sending.
  std::optional<Delivery> poll(Time now, std::uint32_t link, Direction direction,
                               std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// The same over all links, ordered by (time, link, direction, sequence).
  std::optional<Delivery> poll_any(Time now, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// Returns the next time at which a datagram is due or a waiting one is decided, on this link and direction or on
  /// any. The decision may be earlier than the due time.
  [[nodiscard]] std::optional<Time> next_due(std::uint32_t link, Direction direction) const noexcept;
  /// The same on any link and direction.
  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  /// Returns the counters of one direction; zeros for an unknown link.
  [[nodiscard]] const PathCounters& counters(std::uint32_t link, Direction direction) const noexcept;
  /// Reports later events of this link to `watch`, which must outlive the attachment; nullptr detaches.
  void attach_monitor(std::uint32_t link, LinkMonitor* watch) noexcept;
  /// Returns the number of datagrams of a replay that got their own recorded fate; 0 for other links.
  [[nodiscard]] std::uint64_t replayed(std::uint32_t link, Direction direction) const noexcept;

 private:
  struct StoredDirection;
  /// Link shared by several clients.
  struct Shared {
    LinkSchedule schedule;
    std::array<std::shared_ptr<LinkTimeline>, kDirections> timelines;
    std::uint32_t flows = 0;
    std::uint32_t first = 0;  ///< its first client, which is the link's number in the log
  };
  /// Adds a client whose directions `make(direction)` returns.
  /// @param logged_link  link number in the log; empty: the client's number
  template <typename Make>
  std::uint32_t add(const Make& make, const std::vector<LinkSchedule::AddressChange>& rebinds,
                    std::optional<std::uint32_t> logged_link = {});
  [[nodiscard]] StoredDirection* stored(std::uint32_t link, Direction direction) const noexcept;
  Outcome enter(Time now, std::uint32_t link, Direction direction, std::uint32_t address,
                std::span<const std::byte> bytes) noexcept;
  std::optional<Delivery> take(StoredDirection& from, Time now, std::span<std::byte> buffer) noexcept;

  std::uint64_t seed_;
  DecisionSink* sink_ = nullptr;
  std::vector<std::unique_ptr<StoredDirection>> directions_;  ///< link * 2 + direction
  std::vector<Addresses> addresses_;                          ///< by link
  std::vector<Shared> shared_;
};

}  // namespace tandem::netsim
