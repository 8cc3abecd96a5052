#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/delay_queue.h"
#include "netsim/path.h"
#include "netsim/script.h"

namespace tandem::netsim {

class Lane;

/// One direction of one link over time: the path in force and those to come, and the clients that are on it: one, or
/// several that share it. It hands the verdicts that come later than the datagram to the lane they belong to. All
/// memory is taken by the constructor and `join`.
class Course {
 public:
  /// The link of one client. @param name  what its randomness is keyed by
  /// @throws std::invalid_argument listing all problems of the schedule's specs.
  Course(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name);
  /// The `number`-th link that clients share, with room for so many of them.
  struct Shared {
    std::uint32_t number = 0;
    std::uint32_t flows = 1;
  };
  Course(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, const Shared& shared);

  /// A client comes on the link, in the place of one that left if there was one; setup only.
  /// @param flow  at most the clients so far, or the room
  /// @param name  what the draws of its own hang on
  void join(std::uint32_t flow, std::uint64_t name);
  /// Where later verdicts go. Both stay where they are until `leave`.
  void tell(std::uint32_t flow, Lane* lane, DelayQueue* queue) noexcept { members_[flow] = {lane, queue}; }
  /// The client of a flow is no more; its datagrams still use the link, and nobody hears of them.
  void leave(std::uint32_t flow) noexcept;

  /// Decides about one datagram; changes of the schedule that are due come first.
  Verdict send(Time now, std::uint32_t flow, std::size_t size) noexcept TANDEM_REALTIME {
    catch_up(now);
    if (path_->defers()) hand_out(now);
    return path_->send(now, flow, size);
  }
  /// The datagram just sent waits in this slot of the lane's queue; what is known by now is handed out.
  void keep(Time now, std::uint32_t flow, std::uint32_t slot) noexcept TANDEM_REALTIME {
    path_->set_ticket(flow, slot);
    hand_out(now);
  }
  /// Hands out what is decided by `now`.
  void settle(Time now) noexcept TANDEM_REALTIME {
    if (!path_->defers()) return;
    catch_up(now);
    hand_out(now);
  }
  [[nodiscard]] std::optional<Time> next_settle() const noexcept {
    return path_->defers() ? path_->next_settle() : std::nullopt;
  }

  /// How long what comes at `now` would wait in the queue of the rate, as the link is at present.
  [[nodiscard]] Duration queue_wait(Time now) const noexcept { return path_->queue_wait(now); }

  /// `next` is in force from `now` on; afterwards it holds the path that was. Changes of the schedule still come.
  void change(Time now, std::unique_ptr<Path>& next) noexcept TANDEM_REALTIME;

 private:
  struct Later {
    Time at;
    std::unique_ptr<Path> path;
  };
  struct Member {
    Lane* lane = nullptr;
    DelayQueue* queue = nullptr;
  };
  template <typename Make>
  void plan(const LinkSchedule& schedule, Direction direction, const Make& make);
  void catch_up(Time now) noexcept {
    while (next_ < later_.size() && later_[next_].at <= now) change(later_[next_].at, later_[next_].path), ++next_;
  }
  void hand_out(Time now) noexcept;
  void hand(const Path::Settled& settled) noexcept;

  std::unique_ptr<Path> path_;
  std::vector<Later> later_;
  std::size_t next_ = 0;
  std::vector<Member> members_;
};

/// A path of client `name` as every driver of the engine makes it.
[[nodiscard]] std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                              std::uint64_t name);
/// The same of a link that clients share.
[[nodiscard]] std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                              const Course::Shared& shared);

}  // namespace tandem::netsim
