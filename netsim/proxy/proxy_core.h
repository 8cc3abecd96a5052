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
#include "netsim/engine/delay_queue.h"
#include "netsim/engine/link_direction.h"
#include "netsim/engine/path.h"
#include "netsim/engine/schedule.h"
#include "netsim/engine/submit.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Prepared change of the network of a running proxy, including all memory. ProxyCore::prepare creates it on any
/// thread; ProxyCore::change uses it once on the packet thread. Afterwards it holds the previous network, which another
/// thread frees.
struct LinkChange {
  /// New paths of one client.
  struct Client {
    std::uint64_t number = 0;  ///< by order of arrival, from 0
    std::array<std::unique_ptr<Path>, kDirections> paths = {};
  };
  std::optional<LinkSpec> for_new;  ///< link of later clients; empty: unchanged
  LinkSpec link;                    ///< requested link
  std::vector<Client> clients = {};
  std::array<std::unique_ptr<Path>, kDirections> shared = {};  ///< paths of the shared link, in place of the clients'
};

/// Proxy logic without sockets and clock: datagrams in, scheduled datagrams out. It uses the same Path and `submit` as
/// the virtual network. Equal seed, client number, times and sizes therefore give equal verdicts; a test verifies this.
class ProxyCore {
 public:
  static constexpr std::size_t kClientsMax = 64;
  /// Maximum number of datagrams in flight of all clients. One direction of one client may use kPerDirectionMax, and
  /// never more than are still free, so that a flooding client leaves space for others.
  static constexpr std::size_t kSlots = 131'072;
  static constexpr std::uint64_t kPerDirectionMax = 65'536;

  /// @throws std::invalid_argument listing all errors of the spec.
  /// @param events  changes by network time, for clients named "1", "2", ... in order of arrival
  ProxyCore(const LinkSpec& spec, std::uint64_t seed, std::vector<NetworkEvent> events = {});

  /// Sends every later decision to `sink`; null: to none. Links and flows are numbered by arrival from 0.
  void log_to(DecisionSink* sink) noexcept;
  /// Logs all datagrams in flight. This completes a log.
  void log_in_flight() const noexcept;

  /// Resources of a future client. `prepare_client` allocates them on any thread; they are used once.
  struct PreparedClient {
    std::uint64_t version = 0;  ///< version of the link of new clients
    std::uint64_t number = 0;   ///< by order of arrival, from 0
    Addresses addresses;
    std::array<std::optional<LinkDirection>, kDirections> directions = {};  ///< empty if clients share their link
  };
  /// Allocates the resources of a future client. Reads only immutable members, so any thread may call it.
  /// @param link     link of new clients in that version: the initial one, or that of the newest LinkChange::for_new
  /// @throws std::invalid_argument listing all errors of the spec.
  [[nodiscard]] PreparedClient prepare_client(const LinkSpec& link, std::uint64_t version, std::uint64_t number) const;
  /// Returns the number of changes of the link of new clients.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
  /// Returns whether the resources match the next client and the network in force.
  [[nodiscard]] bool fits(const PreparedClient& newcomer) const noexcept {
    return newcomer.version == version_ && newcomer.number == clients_seen_;
  }

  /// Adds a client in a free place. Its randomness is keyed by the number of earlier clients, so that the n-th client
  /// gets the n-th link of the virtual network.
  /// @param made  prepared resources, used if they `fits`; nothing is then allocated, and `made` keeps what is to be
  /// freed
  /// @return place in [0, kClientsMax); empty if all places are taken
  std::optional<std::uint32_t> add_client(PreparedClient* made = nullptr);
  /// Removes a client and frees its place. Its datagrams in flight are dropped when due.
  void remove_client(std::uint32_t client) noexcept;
  [[nodiscard]] std::size_t clients() const noexcept { return clients_; }
  [[nodiscard]] std::uint64_t clients_seen() const noexcept { return clients_seen_; }

  /// Returns the number of a connected client, by order of arrival from 0.
  [[nodiscard]] std::optional<std::uint64_t> number(std::uint32_t client) const noexcept;

  /// Allocates a change of the network. Reads only immutable members, so any thread may call it.
  /// @param numbers  connected clients to change (ProxyCore::number)
  /// @param all      true: also clients that arrive later or have arrived since
  /// @throws std::invalid_argument listing all errors of the spec, or if the change covers only some clients of a
  /// shared link. The initial spec determines whether clients share a link.
  [[nodiscard]] LinkChange prepare(const LinkSpec& link, std::span<const std::uint64_t> numbers, bool all) const;

  /// Puts the links of `change` in force from `now` on. Outages of the events persist, and later events still apply.
  /// Allocates nothing, except for clients that arrived after an `all` was prepared. Skips clients that left.
  void change(Time now, LinkChange& change);

  /// Changes the client's address at `now`: its later datagrams carry the next address number.
  /// @return false: unknown client, or it already has Addresses::kMax addresses
  bool rebind(Time now, std::uint32_t client, const Rebind& rebind) noexcept TANDEM_REALTIME;

  /// Returns the address number from which a connected client sends at `now`, from 0. `dead` returns whether one of its
  /// addresses is dead at `now`.
  [[nodiscard]] std::uint32_t address(Time now, std::uint32_t client) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool dead(Time now, std::uint32_t client, std::uint32_t address) const noexcept TANDEM_REALTIME;

  /// Enters a datagram of at most kSlotBytes that arrived at `now`.
  /// @param address  down: address of the client to which the datagram was sent; up: ignored, the current address
  /// applies
  Outcome ingress(Time now, std::uint32_t client, Direction direction, std::span<const std::byte> bytes,
                  std::uint32_t address = 0) noexcept TANDEM_REALTIME;

  /// Datagram to be sent. `bytes` stay valid until `done`.
  struct Egress {
    std::uint32_t client = 0;
    Direction direction = Direction::kUp;
    std::span<const std::byte> bytes;
    DelayQueue::Item item;
    std::uint32_t address = 0;  ///< address number of the client; up: sender, down: destination
  };
  /// Returns the next datagram due at `now`, in the order (time, arrival).
  /// @param known  all datagrams that arrived up to this time went through `ingress` [<= now]. Verdicts that later
  /// arrivals can change are decided up to this time.
  std::optional<Egress> take(Time now, Time known) noexcept TANDEM_REALTIME;
  std::optional<Egress> take(Time now) noexcept TANDEM_REALTIME { return take(now, now); }
  /// Frees the bytes after sending.
  void done(const Egress& egress) noexcept TANDEM_REALTIME { queue_.recycle(egress.item.slot); }

  /// Returns the next time at which `take` has a result.
  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  /// Returns the counters of one connected client; `total` returns those of all clients, including those that left.
  [[nodiscard]] const PathCounters& counters(std::uint32_t client, Direction direction) const noexcept;
  /// Returns the wait in the rate's queue of a datagram of this client that arrives at `now`. On a shared link this
  /// includes the datagrams of all clients.
  [[nodiscard]] Duration queue_wait(Time now, std::uint32_t client, Direction direction) const noexcept;
  [[nodiscard]] PathCounters total(Direction direction) const noexcept;

  /// Reports later events of a connected client's link to `watch`. It must live until the client is removed or nullptr
  /// is attached.
  void attach_monitor(std::uint32_t client, LinkMonitor* watch) noexcept;

 private:
  struct Client {
    std::array<std::optional<LinkDirection>, kDirections> directions;
    std::uint64_t number = 0;  ///< by order of arrival
    Addresses addresses;
    std::uint32_t generation = 0;  ///< distinguishes datagrams of a client that left from those of its successor
  };
  [[nodiscard]] std::uint32_t path_index(std::uint32_t client, Direction direction) const noexcept;

  [[nodiscard]] bool present(std::uint32_t client) const noexcept {
    return client < kClientsMax && places_[client].directions[0].has_value();
  }
  void resolve(Time now) noexcept;
  void update_may_defer(const LinkSpec& link) noexcept {
    may_defer_ = may_defer_ || defers(link.up) || defers(link.down);
  }
  [[nodiscard]] LinkSchedule schedule(const LinkSpec& link, std::uint64_t number) const;

  LinkSpec spec_;
  const bool sharing_;  ///< true: all clients use `shared_`
  std::array<std::shared_ptr<LinkTimeline>, kDirections> shared_ = {};
  const std::uint64_t seed_;
  const std::vector<NetworkEvent> events_;
  std::vector<NetworkEvent> outages_;  ///< outages of the events; constant after construction
  bool may_defer_ = false;             ///< true: some verdicts may be deferred
  DecisionSink* sink_ = nullptr;
  DelayQueue queue_;
  std::vector<Client> places_;
  std::size_t clients_ = 0;
  std::uint64_t clients_seen_ = 0, version_ = 0;
  std::array<PathCounters, kDirections> departed_counters_;  ///< counters of clients that left
};

}  // namespace tandem::netsim
