#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/decision_log.h"
#include "netsim/engine/path.h"

/// Replay of a decision log as a network.
///
/// A datagram whose index on its path and time of sending match a recorded one gets the recorded fate. Equal traffic
/// therefore gives an equal log, byte for byte.
/// Any other datagram imitates the last fate recorded at or before its time of sending: the same delay or loss, and the
/// same copies. Before the first recorded datagram it imitates the first one.
/// Imitations keep the order: the arrival is at least the latest arrival so far, unless the imitated datagram was
/// reordered.
/// The recording ends one mean gap after the last recorded time of sending and then repeats from its first datagram.
/// A datagram undecided at the end of the log stays undecided when replayed, and other datagrams do not imitate it.
/// Sizes have no effect, and addresses are not recorded.
namespace tandem::netsim {

/// Recorded fates of all flows. Immutable; several ReplayPath objects can share it.
class Replay {
 public:
  /// Recorded decision on one datagram and its copy.
  struct Fate {
    Time in;                ///< recorded time of sending
    Time clock;             ///< maximum of `in` up to this fate
    PathDecision decision;  ///< recorded, with the recorded time of arrival
    [[nodiscard]] Duration delay() const noexcept { return decision.at - in; }
  };
  /// One direction of one flow, in index order.
  struct Track {
    std::vector<Fate> fates = {};
    std::vector<std::uint32_t> decided = {};  ///< indices into `fates` that other traffic can imitate
    Duration period{};                        ///< from the first `clock` to the end
  };

  /// Builds a replay from the rows of a log, in any order.
  /// @return the replay, or an error: no rows, a duplicate datagram, or a copy without its original
  [[nodiscard]] static std::expected<Replay, std::string> make(std::span<const Decision> rows);

  /// Returns the recorded flows, ascending.
  [[nodiscard]] std::vector<std::uint32_t> flows() const;
  /// Returns the link of a flow.
  [[nodiscard]] std::uint32_t link(std::uint32_t flow) const noexcept;
  [[nodiscard]] bool has(std::uint32_t flow) const noexcept { return flows_.contains(flow); }
  /// Returns the track of a flow and direction. If it has no fates, every datagram passes without delay.
  [[nodiscard]] const Track& track(std::uint32_t flow, Direction direction) const noexcept;
  /// Returns the longest delay of a flow and direction. Used to size stores.
  [[nodiscard]] Duration delay_max(std::uint32_t flow, Direction direction) const noexcept;

 private:
  struct Flow {
    std::uint32_t link = 0;
    std::array<Track, kDirections> tracks = {};
  };
  std::map<std::uint32_t, Flow> flows_;
};

/// Player of one direction of one flow; replaces a Path.
class ReplayPath {
 public:
  ReplayPath(std::shared_ptr<const Replay> replay, std::uint32_t flow, Direction direction) noexcept
      : replay_(std::move(replay)), track_(&replay_->track(flow, direction)) {}

  /// Returns the decision on one datagram, as Path::send does; the size has no effect.
  PathDecision send(Time now) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }      ///< datagrams decided
  [[nodiscard]] std::uint64_t matched() const noexcept { return matched_; }  ///< datagrams with their own recorded fate

 private:
  [[nodiscard]] const Replay::Fate* own(Time now, std::uint64_t index) const noexcept;
  [[nodiscard]] const Replay::Fate* at(Time now) const noexcept;

  std::shared_ptr<const Replay> replay_;
  const Replay::Track* track_;
  std::uint64_t count_ = 0, matched_ = 0;
  Time last_in_{}, last_out_{};
};

}  // namespace tandem::netsim
