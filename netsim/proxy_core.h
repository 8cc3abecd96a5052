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
#include "netsim/addresses.h"
#include "netsim/delay_queue.h"
#include "netsim/lane.h"
#include "netsim/path.h"
#include "netsim/path_spec.h"
#include "netsim/script.h"
#include "netsim/submit.h"

namespace tandem::netsim {

/// A change of the network while the proxy runs, with all the memory it needs. Made by ProxyCore::prepare on any
/// thread, used once by ProxyCore::change on the packets' thread; what it holds afterwards is the network that was, to
/// be freed elsewhere.
struct LinkChange {
  struct Client {
    std::uint64_t number = 0;  ///< by arrival, from 0
    std::array<std::unique_ptr<Path>, kDirections> paths = {};
  };
  std::optional<LinkSpec> for_new;  ///< of clients that come later; empty: theirs stays
  LinkSpec link;                    ///< as asked for
  std::vector<Client> clients = {};
  std::array<std::unique_ptr<Path>, kDirections> shared = {};  ///< instead of the clients': of the link they share
};

/// The proxy without sockets and clock: datagrams in, scheduled datagrams out. It uses the same Path and the same way
/// in as the virtual network, so equal seed, client number, times and sizes give equal verdicts (a test holds it to
/// that).
class ProxyCore {
 public:
  static constexpr std::size_t kClientsMax = 64;
  /// Datagrams under way, all clients together; of one direction of one client at most kPerLaneMax, and never more than
  /// are free besides: whoever floods, others find room.
  static constexpr std::size_t kSlots = 131'072;
  static constexpr std::uint64_t kPerLaneMax = 65'536;

  /// @throws std::invalid_argument listing all problems of the spec.
  /// @param events  changes by network time, for clients named "1", "2", ... in order of arrival
  ProxyCore(const LinkSpec& spec, std::uint64_t seed, std::vector<NetworkEvent> events = {});

  /// From now on every decision is told to `sink`; null: nobody. Links and flows are numbered by arrival from 0.
  void log_to(DecisionSink* sink) noexcept;
  /// Tells the sink what is still under way: the end of a complete log.
  void log_waiting() const noexcept;

  /// A client that has not come yet, with all the memory it needs: made by `prepare_newcomer` on any thread, used once.
  struct Newcomer {
    std::uint64_t version = 0;  ///< of the link for those who come
    std::uint64_t number = 0;   ///< by arrival, from 0
    Addresses addresses;
    std::array<std::optional<Lane>, kDirections> lanes = {};  ///< empty where clients share their link
  };
  /// Reads only what never changes.
  /// @param link     what those who come find in that version: of the start, or of the newest LinkChange::for_new
  /// @throws std::invalid_argument listing all problems of the spec.
  [[nodiscard]] Newcomer prepare_newcomer(const LinkSpec& link, std::uint64_t version, std::uint64_t number) const;
  /// Counts the changes of the link for those who come.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
  /// Whether it was made for the client that comes next, under the network in force.
  [[nodiscard]] bool fits(const Newcomer& newcomer) const noexcept {
    return newcomer.version == version_ && newcomer.number == clients_seen_;
  }

  /// Takes a free place for a new client.
  /// @param made  what it needs, if it `fits`: then no memory is taken; it keeps what is to be freed
  /// @return its number in [0, kClientsMax); empty: the house is full
  /// Randomness is keyed by how many clients came before, so the n-th client meets the n-th link of the virtual
  /// network.
  std::optional<std::uint32_t> add_client(Newcomer* made = nullptr);
  /// Frees the place. What is still under way for the client is dropped when due.
  void remove_client(std::uint32_t client) noexcept;
  [[nodiscard]] std::size_t clients() const noexcept { return clients_; }
  [[nodiscard]] std::uint64_t clients_seen() const noexcept { return clients_seen_; }

  /// By arrival, from 0, of a present client.
  [[nodiscard]] std::optional<std::uint64_t> number(std::uint32_t client) const noexcept;

  /// Takes the memory of a change; reads only what never changes, so any thread may call it.
  /// @param numbers  the present clients that it is for (ProxyCore::number)
  /// @param all      also those that come later, and those that came since
  /// @throws std::invalid_argument listing all problems of the spec; or the clients share their link, which changes for
  ///         all of them only. Whether they share is settled by the first spec.
  [[nodiscard]] LinkChange prepare(const LinkSpec& link, std::span<const std::uint64_t> numbers, bool all) const;

  /// The links of `change` are in force from `now` on. Outages of the events stay, further events still come. Takes no
  /// memory, except for clients that came after an `all` was prepared. Clients that left are passed over.
  void change(Time now, LinkChange& change);

  /// The client's address changes at `now`: what it sends from then on comes out with the next number.
  /// @return false: no such client, or it had Addresses::kMax already
  bool rebind(Time now, std::uint32_t client, const Rebind& rebind) noexcept TANDEM_REALTIME;

  /// The address a present client sends from at `now`, from 0; and whether one of its addresses is dead by `now`.
  [[nodiscard]] std::uint32_t address(Time now, std::uint32_t client) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool dead(Time now, std::uint32_t client, std::uint32_t address) const noexcept TANDEM_REALTIME;

  /// A datagram of at most kSlotBytes came in at `now`.
  /// @param address  down: of the client, that the datagram was sent to; up: the present one, whatever is said here
  Outcome ingress(Time now, std::uint32_t client, Direction direction, std::span<const std::byte> bytes,
                  std::uint32_t address = 0) noexcept TANDEM_REALTIME;

  /// Something to be sent: bytes stay valid until `done`.
  struct Egress {
    std::uint32_t client = 0;
    Direction direction = Direction::kUp;
    std::span<const std::byte> bytes;
    DelayQueue::Item item;
    std::uint32_t address = 0;  ///< the client's: up, whom it comes from; down, whom it was sent to
  };
  /// The next datagram due at `now`, in the order (time, arrival).
  /// @param known  everything that came by then went through `ingress` [<= now]: what a later arrival can still change is
  ///               decided up to then
  std::optional<Egress> take(Time now, Time known) noexcept TANDEM_REALTIME;
  std::optional<Egress> take(Time now) noexcept TANDEM_REALTIME { return take(now, now); }
  /// Gives the bytes back after sending.
  void done(const Egress& egress) noexcept TANDEM_REALTIME { queue_.recycle(egress.item.slot); }

  /// When `take` has something to do.
  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  /// Of one present client; of all clients together, also those that left.
  [[nodiscard]] const PathCounters& counters(std::uint32_t client, Direction direction) const noexcept;
  /// How long what this client sends, or is sent, at `now` would wait in the rate's queue; on a shared link behind what all sent.
  [[nodiscard]] Duration queue_wait(Time now, std::uint32_t client, Direction direction) const noexcept;
  [[nodiscard]] PathCounters total(Direction direction) const noexcept;

  /// From now on `watch` is told what happens on the link of this present client; it must live until the client is
  /// removed or nullptr is given.
  void watch(std::uint32_t client, LinkWatch* watch) noexcept;

 private:
  struct Client {
    std::array<std::optional<Lane>, kDirections> lanes;
    std::uint64_t number = 0;  ///< by arrival
    Addresses addresses;
    std::uint32_t generation = 0;  ///< tells datagrams of a client that left from those of its successor
  };
  [[nodiscard]] std::uint32_t lane_name(std::uint32_t client, Direction direction) const noexcept;

  [[nodiscard]] bool present(std::uint32_t client) const noexcept {
    return client < kClientsMax && places_[client].lanes[0].has_value();
  }
  void settle(Time now) noexcept;
  void note(const LinkSpec& link) noexcept { may_defer_ = may_defer_ || defers(link.up) || defers(link.down); }
  [[nodiscard]] LinkSchedule schedule(const LinkSpec& link, std::uint64_t number) const;

  LinkSpec spec_;
  const bool sharing_;  ///< all clients are on `shared_`
  std::array<std::shared_ptr<Course>, kDirections> shared_ = {};
  const std::uint64_t seed_;
  const std::vector<NetworkEvent> events_;
  std::vector<NetworkEvent> outages_;  ///< those of the events; set once
  bool may_defer_ = false;             ///< some datagrams may wait for their verdict
  DecisionSink* sink_ = nullptr;
  DelayQueue queue_;
  std::vector<Client> places_;
  std::size_t clients_ = 0;
  std::uint64_t clients_seen_ = 0, version_ = 0;
  std::array<PathCounters, kDirections> left_;  ///< of clients that left
};

}  // namespace tandem::netsim
