#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/link_timeline.h"
#include "netsim/engine/path.h"
#include "netsim/engine/replay.h"
#include "netsim/engine/schedule.h"
#include "netsim/engine/submit.h"

namespace tandem::netsim {

/// One direction of one client's link, with its counters and decision tap. The link is the client's own, shared, or a
/// recording. The constructor allocates all memory.
class LinkDirection {
 public:
  /// Direction of a link with one client.
  /// @param name  key of the link's randomness
  /// @throws std::invalid_argument listing all errors of the schedule's specs.
  LinkDirection(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name)
      : timeline_(std::make_shared<LinkTimeline>(schedule, direction, seed, name)) {}
  /// Direction of one client on a shared link.
  LinkDirection(std::shared_ptr<LinkTimeline> course, std::uint32_t flow) : timeline_(std::move(course)), flow_(flow) {}
  LinkDirection(std::shared_ptr<const Replay> replay, std::uint32_t flow, Direction direction)
      : replay_(std::in_place, std::move(replay), flow, direction) {}

  /// Attaches this object and the queue that stores its datagrams. Both must keep their addresses. Call before the
  /// first datagram.
  void attach_queue(DelayQueue& queue) noexcept {
    if (timeline_) timeline_->attach(flow_, this, &queue);
  }
  /// Detaches the client, which has left. The object receives no further decisions.
  void detach() noexcept {
    if (timeline_) timeline_->detach(flow_);
  }

  /// Returns the decision on one datagram. Applies schedule changes that are due first.
  PathDecision send(Time now, std::size_t size) noexcept TANDEM_REALTIME {
    return replay_ ? replay_->send(now) : timeline_->send(now, flow_, size);
  }

  /// Processes all waiting datagrams that are decided by `now`: counts, schedules or drops, and logs them. On a shared
  /// link this covers all its clients. Call before taking due items.
  void resolve(Time now) noexcept TANDEM_REALTIME {
    if (timeline_) timeline_->resolve(now);
  }
  /// Returns the next time at which `resolve` has a result if nothing is sent before.
  [[nodiscard]] std::optional<Time> next_resolve() const noexcept {
    return timeline_ ? timeline_->next_resolve() : std::nullopt;
  }
  /// Puts `next` in force from `now` on; afterwards `next` holds the previous path. Later schedule changes still apply.
  /// A recording does not change.
  void change(Time now, std::unique_ptr<Path>& next) noexcept TANDEM_REALTIME {
    if (timeline_) timeline_->change(now, next);
  }

  /// Returns Path::queue_wait; 0 for a recording, which has no such value.
  [[nodiscard]] Duration queue_wait(Time now) const noexcept {
    return timeline_ ? timeline_->queue_wait(now) : Duration{};
  }

  [[nodiscard]] const ReplayPath* replay() const noexcept { return replay_ ? &*replay_ : nullptr; }

  /// Enters one datagram: decides, counts, stores it in `queue` and logs.
  Outcome enter(DelayQueue& queue, const Ingress& entrance, std::span<const std::byte> bytes) noexcept TANDEM_REALTIME {
    return enter(send(entrance.now, bytes.size()), queue, entrance, bytes);
  }
  /// The same with a given decision.
  Outcome enter(const PathDecision& decision, DelayQueue& queue, const Ingress& entrance,
                std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  PathCounters counters = {};
  DecisionTap tap = {};

 private:
  std::shared_ptr<LinkTimeline> timeline_;
  std::uint32_t flow_ = 0;
  std::optional<ReplayPath> replay_;
};

/// Returns the number of slots that the largest link of the schedule can need [datagrams], see Network.
[[nodiscard]] std::size_t slots_for(const LinkSchedule& schedule, Direction direction) noexcept;
[[nodiscard]] std::size_t slots_for(Duration delay_max, double copies) noexcept;

}  // namespace tandem::netsim
