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
#include "netsim/decision_log.h"
#include "netsim/path.h"

/// A decision log becomes a network again.
///
/// A datagram whose number on its path and time of sending are those of a recorded one meets that one's fate: the same
/// traffic gives the same log, byte for byte, whatever made it. Any other datagram, of traffic of another kind, takes
/// the fate of the last one recorded at or before its own time of sending: as long a delay, or the same loss, and the
/// same copies; before the first recorded datagram, that of the first. It never overtakes (its time of arrival is at
/// least the latest one given so far), unless what it imitates was reordered. After the end, which is one mean gap
/// after the last recorded time of sending, the recording starts again with its first datagram. What was not decided
/// yet when the log ended stays undecided for its own datagram, and is imitated by no other. Sizes do not matter, and
/// addresses are not recorded.
namespace tandem::netsim {

/// The recorded fates of all flows. Immutable, shared by those who play it.
class Replay {
 public:
  struct Fate {
    Time in;     ///< as recorded
    Time clock;  ///< the latest `in` up to this one
    std::uint64_t index = 0;
    Duration delay{};       ///< out - in
    Duration copy_delay{};  ///< after the original
    Outcome outcome = Outcome::kDeliver;
    Outcome copy_outcome = Outcome::kDeliver;
    bool copied = false;
    Damage damage = {};
  };
  /// One direction of one flow, by index.
  struct Track {
    std::vector<Fate> fates = {};
    std::vector<std::uint32_t> decided = {};  ///< places of those that other traffic can imitate
    Duration period{};                        ///< from the first `clock` to the end
  };

  /// @param rows  of a log, in any order
  /// @return what can be played, or what is wrong: nothing recorded, a datagram twice, a copy without its original
  [[nodiscard]] static std::expected<Replay, std::string> make(std::span<const Decision> rows);

  /// The flows recorded, ascending.
  [[nodiscard]] std::vector<std::uint32_t> flows() const;
  /// The link a flow went over.
  [[nodiscard]] std::uint32_t link(std::uint32_t flow) const noexcept;
  [[nodiscard]] bool has(std::uint32_t flow) const noexcept { return flows_.contains(flow); }
  /// Empty of fates when nothing was recorded there: then everything passes at once.
  [[nodiscard]] const Track& track(std::uint32_t flow, Direction direction) const noexcept;
  /// The longest delay of a flow and direction; for sizing stores.
  [[nodiscard]] Duration delay_max(std::uint32_t flow, Direction direction) const noexcept;

 private:
  struct Flow {
    std::uint32_t link = 0;
    std::array<Track, kDirections> tracks = {};
  };
  std::map<std::uint32_t, Flow> flows_;
};

/// Plays one direction of one flow, in the place of a Path.
class ReplayPath {
 public:
  ReplayPath(std::shared_ptr<const Replay> replay, std::uint32_t flow, Direction direction) noexcept
      : replay_(std::move(replay)), track_(&replay_->track(flow, direction)) {}

  /// As Path::send; the size does not matter.
  Verdict send(Time now) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }      ///< datagrams decided about
  [[nodiscard]] std::uint64_t matched() const noexcept { return matched_; }  ///< those that met their own fate

 private:
  [[nodiscard]] const Replay::Fate* own(Time now, std::uint64_t index) const noexcept;
  [[nodiscard]] const Replay::Fate* at(Time now) const noexcept;

  std::shared_ptr<const Replay> replay_;
  const Replay::Track* track_;
  std::uint64_t count_ = 0, matched_ = 0;
  Time last_in_{}, last_out_{};
};

}  // namespace tandem::netsim
