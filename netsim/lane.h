#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/course.h"
#include "netsim/path.h"
#include "netsim/replay.h"
#include "netsim/script.h"
#include "netsim/submit.h"

namespace tandem::netsim {

/// One direction of one client's link, its own or one it shares, or a recording in its place; what it counted, and who
/// is told. All memory is taken by the constructor.
class Lane {
 public:
  /// A link of its own. @param name  what the randomness is keyed by
  /// @throws std::invalid_argument listing all problems of the schedule's specs.
  Lane(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name)
      : course_(std::make_shared<Course>(schedule, direction, seed, name)) {}
  /// One of those on a link that clients share.
  Lane(std::shared_ptr<Course> course, std::uint32_t flow) : course_(std::move(course)), flow_(flow) {}
  Lane(std::shared_ptr<const Replay> replay, std::uint32_t flow, Direction direction)
      : replay_(std::in_place, std::move(replay), flow, direction) {}

  /// The lane and the queue that keeps its datagrams are where they will stay. Before the first datagram.
  void settle_in(DelayQueue& queue) noexcept {
    if (course_) course_->tell(flow_, this, &queue);
  }
  /// The client is no more: nothing is told to the lane.
  void retire() noexcept {
    if (course_) course_->leave(flow_);
  }

  /// Decides about one datagram; changes of the schedule that are due come first.
  Verdict send(Time now, std::size_t size) noexcept TANDEM_REALTIME {
    return replay_ ? replay_->send(now) : course_->send(now, flow_, size);
  }

  /// What waited and is decided by `now` is counted, let go or dropped, told; on a shared link that of all its lanes.
  /// Before whatever is due is taken.
  void settle(Time now) noexcept TANDEM_REALTIME {
    if (course_) course_->settle(now);
  }
  /// When `settle` has something to say, if nothing is sent before.
  [[nodiscard]] std::optional<Time> next_settle() const noexcept {
    return course_ ? course_->next_settle() : std::nullopt;
  }
  /// `next` is in force from `now` on; afterwards it holds the path that was. Changes of the schedule still come. A
  /// recording is not changed.
  void change(Time now, std::unique_ptr<Path>& next) noexcept TANDEM_REALTIME {
    if (course_) course_->change(now, next);
  }

  /// See Path::queue_wait; of a recording 0: it does not tell.
  [[nodiscard]] Duration queue_wait(Time now) const noexcept { return course_ ? course_->queue_wait(now) : Duration{}; }

  [[nodiscard]] const ReplayPath* replay() const noexcept { return replay_ ? &*replay_ : nullptr; }

  /// One datagram goes in: decided, counted, kept in `queue`, told to whoever listens.
  Outcome enter(DelayQueue& queue, const Entrance& entrance,
                std::span<const std::byte> bytes) noexcept TANDEM_REALTIME {
    return enter(send(entrance.now, bytes.size()), queue, entrance, bytes);
  }
  /// The same with a verdict of the caller's.
  Outcome enter(const Verdict& verdict, DelayQueue& queue, const Entrance& entrance,
                std::span<const std::byte> bytes) noexcept TANDEM_REALTIME;

  PathCounters counters = {};
  DecisionTap tap = {};

 private:
  std::shared_ptr<Course> course_;
  std::uint32_t flow_ = 0;
  std::optional<ReplayPath> replay_;
};

/// The largest store that any link of the schedule may need: see Network. [datagrams]
[[nodiscard]] std::size_t slots_for(const LinkSchedule& schedule, Direction direction) noexcept;
[[nodiscard]] std::size_t slots_for(Duration delay_max, double copies) noexcept;

}  // namespace tandem::netsim
