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
#include "netsim/replay.h"
#include "netsim/script.h"
#include "netsim/submit.h"

namespace tandem::netsim {

/// A datagram that came out.
struct Delivery {
  std::uint32_t link = 0;
  Direction direction = Direction::kUp;
  Time sent;
  Time at;
  std::uint64_t index = 0;    ///< of the datagram on its path; a copy has the index of its original
  std::size_t size = 0;       ///< [bytes]; also when the buffer was smaller and the rest was cut off
  std::uint32_t address = 0;  ///< the client's, counted from 0: up, whom it came from; down, whom it was sent to
};

/// Links of a virtual network: datagrams go in, and come out when the caller's clock has reached their time.
/// All memory is taken by `add_link` and `add_replay`; `send` and `poll` take none, also when a link changes. Same
/// seed, specs and calls: same deliveries.
class Network {
 public:
  explicit Network(std::uint64_t seed) noexcept : seed_(seed) {}

  /// Adds a client's link; setup only.
  /// @param name  what the link's randomness is keyed by, so that other links do not move it; default: its number
  /// @return the link's number: 0, 1, ...
  /// @throws std::invalid_argument listing all problems of the spec.
  std::uint32_t add_link(const LinkSpec& spec);
  std::uint32_t add_link(const LinkSpec& spec, std::uint64_t name);
  /// The same with changes: each is in force from its own time on, whenever datagrams come.
  std::uint32_t add_link(const LinkSchedule& schedule, std::uint64_t name);
  /// Adds a link that clients share; setup only. Clients whose specs say `shared` need no call of their own: `add_link`
  /// puts those with equal specs and changes on one link.
  /// @return its number among the shared ones: 0, 1, ...; what its processes in time are keyed by
  std::uint32_t add_shared(const LinkSchedule& schedule);
  std::uint32_t add_shared(const LinkSpec& spec) { return add_shared(LinkSchedule{.initial = spec}); }
  /// Adds a client to it.
  /// @param name  what the draws of its own are keyed by
  /// @return a number as that of `add_link`
  std::uint32_t add_flow(std::uint32_t shared, std::uint64_t name,
                         const std::vector<LinkSchedule::AddressChange>& rebinds = {});
  /// Adds a link that does again what was recorded of `flow`; seed and name do not matter.
  std::uint32_t add_replay(std::shared_ptr<const Replay> replay, std::uint32_t flow);

  /// From now on every decision is told to `sink`; null: nobody. Setup only; the sink must outlive the network.
  void log_to(DecisionSink* sink) noexcept;
  /// The earliest time of entering of anything under way, or none: what entered before that is all in the log.
  [[nodiscard]] std::optional<Time> oldest_under_way() const noexcept;
  /// Tells the sink what is still under way: the end of a complete log.
  void log_waiting() const noexcept;

  /// Clients, each on a link of its own or on a shared one.
  [[nodiscard]] std::size_t links() const noexcept { return addresses_.size(); }

  /// Sends one datagram of at most kSlotBytes.
  /// Up: from the address the client has at `now`; down: to the newest address anything delivered came from.
  /// @return what was decided; an unknown link drops (kOverflow)
  Outcome send(Time now, std::uint32_t link, Direction direction,
               std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// The same down to one of the client's addresses, which may be dead when the datagram arrives: then it is dropped.
  Outcome send_to(Time now, std::uint32_t link, std::uint32_t address,
                  std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  /// The client's address changes at `now`, besides the changes of its schedule.
  /// @return false: unknown link, or it had Addresses::kMax already
  bool rebind(Time now, std::uint32_t link, const Rebind& rebind) noexcept TANDEM_REALTIME;

  /// Takes the next datagram of this link and direction that is due at `now` into `buffer`; call until empty.
  /// Without delay a datagram is due at the very `now` it was sent. Equal times: order of sending.
  std::optional<Delivery> poll(Time now, std::uint32_t link, Direction direction,
                               std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// The same over all links, ordered by (time, link, direction, sequence).
  std::optional<Delivery> poll_any(Time now, std::span<std::byte> buffer) noexcept TANDEM_REALTIME;

  /// When the next datagram is due on this link and direction, or on any; or a waiting one is decided about, which may
  /// be earlier than it is due.
  [[nodiscard]] std::optional<Time> next_due(std::uint32_t link, Direction direction) const noexcept;
  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  [[nodiscard]] const PathCounters& counters(std::uint32_t link, Direction direction) const noexcept;
  /// From now on `watch` is told what happens on this link, until it is told no more (nullptr); it must live as long.
  void watch(std::uint32_t link, LinkWatch* watch) noexcept;
  /// Of a link that replays: datagrams that met their own recorded fate; else 0.
  [[nodiscard]] std::uint64_t replayed(std::uint32_t link, Direction direction) const noexcept;

 private:
  struct Stored {
    Stored(Lane&& with, std::size_t slots) : lane(std::move(with)), queue(slots) { lane.settle_in(queue); }
    [[nodiscard]] std::optional<Time> next_due() const noexcept;
    Lane lane;
    DelayQueue queue;
  };
  /// A link that several clients are on.
  struct Shared {
    LinkSchedule schedule;
    std::array<std::shared_ptr<Course>, kDirections> courses;
    std::uint32_t flows = 0;
    std::uint32_t first = 0;  ///< its first client: the number of the link in the log
  };
  std::uint32_t add(std::unique_ptr<Stored> up, std::unique_ptr<Stored> down,
                    const std::vector<LinkSchedule::AddressChange>& rebinds);
  [[nodiscard]] Stored* stored(std::uint32_t link, Direction direction) const noexcept;
  Outcome enter(Time now, std::uint32_t link, Direction direction, std::uint32_t address,
                std::span<const std::byte> bytes) noexcept;
  std::optional<Delivery> take(Stored& from, Time now, std::span<std::byte> buffer) noexcept;

  std::uint64_t seed_;
  DecisionSink* sink_ = nullptr;
  std::vector<std::unique_ptr<Stored>> lanes_;  ///< link * 2 + direction
  std::vector<Addresses> addresses_;            ///< by link
  std::vector<Shared> shared_;
};

}  // namespace tandem::netsim
