#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/path.h"
#include "netsim/replay.h"
#include "netsim/script.h"
#include "netsim/submit.h"

namespace tandem::netsim {

/// One direction of one client's link over time: the path in force and those to come, or a recording in their place;
/// what it counted, and who is told. All memory is taken by the constructor.
class Lane {
 public:
  /// @param name  what the randomness is keyed by
  /// @throws std::invalid_argument listing all problems of the schedule's specs.
  Lane(const LinkSchedule& schedule, Direction direction, std::uint64_t seed, std::uint64_t name);
  Lane(std::shared_ptr<const Replay> replay, std::uint32_t flow, Direction direction)
      : replay_(std::in_place, std::move(replay), flow, direction) {}

  /// Decides about one datagram; changes of the schedule that are due come first.
  Verdict send(Time now, std::size_t size) noexcept TANDEM_REALTIME {
    if (replay_) return replay_->send(now);
    while (next_ < later_.size() && later_[next_].at <= now) switch_to(later_[next_].path, later_[next_].at), ++next_;
    return path_->send(now, size);
  }

  /// `next` is in force from `now` on; afterwards it holds the path that was. Changes of the schedule still come. A
  /// recording is not changed.
  void change(Time now, std::unique_ptr<Path>& next) noexcept TANDEM_REALTIME {
    if (!replay_) switch_to(next, now);
  }

  [[nodiscard]] const ReplayPath* replay() const noexcept { return replay_ ? &*replay_ : nullptr; }

  PathCounters counters = {};
  DecisionTap tap = {};

 private:
  struct Later {
    Time at;
    std::unique_ptr<Path> path;
  };
  void switch_to(std::unique_ptr<Path>& next, Time at) noexcept;

  std::unique_ptr<Path> path_;
  std::vector<Later> later_;
  std::size_t next_ = 0;
  std::optional<ReplayPath> replay_;
};

/// A path of client `name` as every driver of the engine makes it.
[[nodiscard]] std::unique_ptr<Path> make_path(const LinkSpec& link, Direction direction, std::uint64_t seed,
                                              std::uint64_t name);

/// The largest store that any link of the schedule may need: see Network. [datagrams]
[[nodiscard]] std::size_t slots_for(const LinkSchedule& schedule, Direction direction) noexcept;
[[nodiscard]] std::size_t slots_for(Duration delay_max, double copies) noexcept;

}  // namespace tandem::netsim
