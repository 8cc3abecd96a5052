#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "netsim/engine/delay_queue.h"
#include "netsim/proxy/client_table.h"
#include "netsim/proxy/link_factory.h"

namespace tandem::netsim {

/// Proxy logic without sockets and clock: datagrams in, scheduled datagrams out. It uses the same Path and `submit` as
/// the virtual network. Equal seed, client number, times and sizes therefore give equal decisions; a test verifies
/// this.
class ProxyCore {
 public:
  static constexpr std::size_t kClientsMax = ClientTable::kMax;
  /// Maximum number of datagrams in flight of all clients. One direction of one client may use kPerDirectionMax, and
  /// never more than are still free, so that a flooding client leaves space for others.
  static constexpr std::size_t kSlots = 131'072;
  static constexpr std::uint64_t kPerDirectionMax = 65'536;

  /// @throws std::invalid_argument listing all errors of the spec.
  /// @param events  changes by network time, for clients named "1", "2", ... in order of arrival
  ProxyCore(const LinkSpec& spec, std::uint64_t seed, const std::vector<NetworkEvent>& events = {});

  /// Sends every later decision to `sink`; null: to none. Links and flows are numbered by arrival from 0.
  void log_to(DecisionSink* sink) noexcept;
  /// Logs all datagrams in flight. This completes a log.
  void log_in_flight() const noexcept;

  /// Returns the factory of clients' links and of changes, which any thread may use.
  [[nodiscard]] const LinkFactory& links() const noexcept { return links_; }
  /// Returns the number of changes of the link of new clients.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
  /// Returns whether the resources match the next client and the network in force.
  [[nodiscard]] bool fits(const PreparedLink& prepared) const noexcept {
    return prepared.version == version_ && prepared.number == clients_.seen();
  }

  /// Adds a client in a free place.
  /// @param prepared  prepared resources, used if they `fits`; nothing is then allocated, and `prepared` keeps what is
  /// to be freed
  /// @return place in [0, kClientsMax); empty if all places are taken
  std::optional<std::uint32_t> add_client(PreparedLink* prepared = nullptr);
  /// Removes a client and frees its place. Its datagrams in flight are dropped when due.
  void remove_client(std::uint32_t client) noexcept;
  [[nodiscard]] const ClientTable& clients() const noexcept { return clients_; }

  /// Puts the links of `change` in force from `now` on. Outages of the events persist, and later events still apply.
  /// Allocates nothing, except for clients that arrived after an `all` was prepared. Skips clients that left.
  void change(Time now, LinkChange& change);

  /// Changes the client's address at `now`: its later datagrams carry the next address number.
  /// @return false: unknown client, or it already has Addresses::kMax addresses
  bool rebind(Time now, std::uint32_t client, const Rebind& rebind) noexcept TANDEM_REALTIME;

  /// Returns the address number from which a connected client sends at `now`, from 0.
  [[nodiscard]] std::uint32_t address(Time now, std::uint32_t client) noexcept TANDEM_REALTIME;

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
  /// @param known  all datagrams that arrived up to this time went through `ingress` [<= now]. Decisions that later
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

  /// Reports later events of a connected client's link to `monitor`. It must live until the client is removed or
  /// nullptr is attached.
  void attach_monitor(std::uint32_t client, LinkMonitor* monitor) noexcept;

 private:
  void resolve(Time now) noexcept;
  void update_may_defer(const LinkSpec& link) noexcept {
    may_defer_ = may_defer_ || defers(link.up) || defers(link.down);
  }

  LinkSpec spec_;  ///< link of new clients
  LinkFactory links_;
  std::array<std::shared_ptr<LinkTimeline>, kDirections> shared_ = {};  ///< link of all clients, if they share it
  bool may_defer_ = false;                                              ///< true: some decisions may be deferred
  DecisionSink* sink_ = nullptr;
  DelayQueue queue_;
  ClientTable clients_;
  std::uint64_t version_ = 0;
  std::array<PathCounters, kDirections> departed_counters_;  ///< counters of clients that left
};

}  // namespace tandem::netsim
