#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/delay_queue.h"
#include "netsim/engine/path.h"
#include "netsim/engine/schedule.h"

namespace tandem::netsim {

class LinkDirection;

/// One direction of one link over time: the active path, the planned paths and the clients. One or more clients use the
/// link. It forwards deferred decisions to the LinkDirection of their client. The constructor and `join` allocate all
/// memory.
class LinkTimeline {
 public:
  /// Link of one client.
  /// @param name  key of the link's randomness
  /// @throws std::invalid_argument listing all errors of the schedule's specs.
  LinkTimeline(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name);
  /// Link that several clients share: its number, and the maximum number of clients.
  struct Shared {
    std::uint32_t number = 0;
    std::uint32_t flows = 1;
  };
  LinkTimeline(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, const Shared& shared);

  /// Adds a client, or replaces one that left. Setup only.
  /// @param flow  at most the number of clients so far, below the maximum
  /// @param name  key of the client's per-datagram draws
  void join(std::uint32_t flow, std::uint64_t name);
  /// Sets the receiver of deferred decisions. Both objects must keep their addresses until `detach`.
  void attach(std::uint32_t flow, LinkDirection* lane, DelayQueue* queue) noexcept { clients_[flow] = {lane, queue}; }
  /// Detaches the client of a flow. Its datagrams still use the link; their decisions are discarded.
  void detach(std::uint32_t flow) noexcept;

  /// Returns the decision on one datagram. Applies schedule changes that are due first.
  PathDecision send(Time now, std::uint32_t flow, std::size_t size) noexcept TANDEM_REALTIME {
    apply_due_changes(now);
    if (path_->defers()) dispatch_resolved(now);
    return path_->send(now, flow, size);
  }
  /// Registers the slot of the datagram just sent, whose decision is open. Then dispatches the decisions known by
  /// `now`.
  void defer(Time now, std::uint32_t flow, std::uint32_t slot) noexcept TANDEM_REALTIME {
    path_->set_ticket(flow, slot);
    dispatch_resolved(now);
  }
  /// Dispatches the decisions that are final at `now`.
  void resolve(Time now) noexcept TANDEM_REALTIME {
    if (!path_->defers()) return;
    apply_due_changes(now);
    dispatch_resolved(now);
  }
  [[nodiscard]] std::optional<Time> next_resolve() const noexcept {
    return path_->defers() ? path_->next_resolve() : std::nullopt;
  }

  /// Returns the queue wait of a datagram that arrives at `now`, with the present state of the link.
  [[nodiscard]] Duration queue_wait(Time now) const noexcept { return path_->queue_wait(now); }

  /// Puts `next` in force from `now` on; afterwards `next` holds the previous path. Later schedule changes still apply.
  void change(Time now, std::unique_ptr<Path>& next) noexcept TANDEM_REALTIME;

 private:
  struct PlannedChange {
    Time at;
    std::unique_ptr<Path> path;
  };
  struct Client {
    LinkDirection* direction = nullptr;
    DelayQueue* queue = nullptr;
  };
  template <typename Make>
  void plan(const LinkSchedule& schedule, Direction direction, const Make& make);
  void apply_due_changes(Time now) noexcept {
    while (next_ < planned_.size() && planned_[next_].at <= now)
      change(planned_[next_].at, planned_[next_].path), ++next_;
  }
  void dispatch_resolved(Time now) noexcept;
  void dispatch(const Path::Resolved& settled) noexcept;

  std::unique_ptr<Path> path_;
  std::vector<PlannedChange> planned_;
  std::size_t next_ = 0;
  std::vector<Client> clients_;
};

/// Creates the path of client `name`. Every user of the engine creates paths with this function.
[[nodiscard]] std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                              std::uint64_t name);
/// The same for a shared link.
[[nodiscard]] std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                              const LinkTimeline::Shared& shared);

}  // namespace tandem::netsim
