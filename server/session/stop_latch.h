#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/base/axes.h"
#include "common/base/fixed_text.h"
#include "common/base/time.h"
#include "proto/rpc/rpc_limits.h"
#include "server/policy/roles.h"
#include "server/session/command_result.h"

namespace tandem::server {

/// The session's stop: latched and numbered. While it is on, no seat is engaged. A participant ends it by naming the
/// newest number, so that a late request never ends a newer stop.
///
/// A stop can be ended by any role that may stop. In scenes without an instructor's seat, a pause is also ended by the
/// participants who made it. Each of them withdraws their own pause; the pause ends when no seat holds it any more.
/// Seats that are not connected do not hold a pause.
class StopLatch {
 public:
  enum class Level : std::uint8_t { kNone, kPaused, kStopped };
  static constexpr std::uint8_t kNoSeat = 255;  ///< no seat

  /// @param led  the scene has an instructor's seat
  explicit StopLatch(bool led = true) noexcept : has_instructor_(led) {}

  /// Names and reason of a stop, which only control connections give.
  struct Words {
    FixedText<rpc::kNameMax> workstation;
    FixedText<rpc::kNameMax> person;  ///< name in the ticket; empty: not named
    FixedText<rpc::kTextMax> why;
  };
  /// The newest stop.
  struct Latest {
    Level level = Level::kNone;  ///< kNone: none so far, or the snapshot of this session does not name its author
    std::uint8_t by = kNoSeat;   ///< a seat, or AuditEvent::kControlPlane; kNoSeat: the session itself
    AccessRole role = AccessRole::kObserver;
    Time at{};
    Words words{};
    bool restored = false;  ///< an earlier server process of this session took it
  };

  /// The stop that was ended last.
  struct Ended {
    std::uint32_t number = 0;   ///< 0: none since this server began
    std::uint8_t by = kNoSeat;  ///< a seat, or AuditEvent::kControlPlane
    AccessRole role = AccessRole::kObserver;
  };
  [[nodiscard]] const Ended& ended() const noexcept { return ended_; }

  [[nodiscard]] Level level() const noexcept { return level_; }
  [[nodiscard]] bool latched() const noexcept { return level_ != Level::kNone; }
  [[nodiscard]] bool has_instructor() const noexcept { return has_instructor_; }
  /// Number of stops so far, which is the number of the newest.
  [[nodiscard]] std::uint32_t stops() const noexcept { return stops_; }
  [[nodiscard]] const Latest& latest() const noexcept { return latest_; }

  /// Raises the stop to the level that the role may request.
  /// @param by      seat of the participant, or AuditEvent::kControlPlane
  /// @param wanted  highest level
  /// @return the level that was requested; nothing if the role may not stop
  std::optional<Level> request(Time now, AccessRole who, std::uint8_t by, Level wanted = Level::kStopped,
                               const Words& words = {}) noexcept {
    const Grant grant = allowed(who, Right::kStopSession);
    if (grant == Grant::kNo) return std::nullopt;
    const Level level = grant == Grant::kYes ? wanted : Level::kPaused;
    const bool his_own = grant == Grant::kPart && by < kSeatsMax;
    const std::uint32_t held = latched() ? holders_ : 0;
    const bool bound = latched() && needs_stop_right_;
    raise(level, {level, by, who, now, words});
    holders_ = his_own ? held | 1U << by : held;
    needs_stop_right_ = bound || !his_own;
    return level;
  }
  /// Raises the stop on behalf of the session: after a repeated fault, or to restore a stop after a restart. The level
  /// never falls from stop to pause.
  void raise(Level level, const Latest& newest) noexcept {
    holders_ = latched() ? holders_ : 0;
    needs_stop_right_ = latched() && needs_stop_right_;
    level_ = level > level_ ? level : level_;
    latest_ = newest;
    ++stops_;
  }

  /// Whether the role may end any stop.
  [[nodiscard]] static bool may_resume(AccessRole who) noexcept {
    return allowed(who, Right::kStopSession) == Grant::kYes;
  }
  /// Whether the participants who paused may end this pause themselves.
  [[nodiscard]] bool pause_ends_by_its_makers() const noexcept {
    return level_ == Level::kPaused && !has_instructor_ && !needs_stop_right_;
  }
  /// Seats that hold the pause, bit i for seat i. @param there connected seats
  [[nodiscard]] std::uint32_t holders(std::uint32_t there) const noexcept { return latched() ? holders_ & there : 0; }
  [[nodiscard]] bool may_end(AccessRole who, std::uint8_t seat) const noexcept {
    return may_resume(who) ||
           (pause_ends_by_its_makers() && seat < kSeatsMax && allowed(who, Right::kEndPause) != Grant::kNo);
  }
  /// Whether the participant may end something now: any stop, a pause of their own, or a pause that no connected seat
  /// holds.
  [[nodiscard]] bool may_be_ended_by(AccessRole who, std::uint8_t seat, std::uint32_t there) const noexcept {
    return latched() && may_end(who, seat) &&
           (may_resume(who) || holders(there) == 0 || (holders(there) >> seat & 1U) != 0);
  }

  /// Ends the stop, or withdraws the participant's own pause.
  /// @return kDone, kHeldByOthers, kForbidden or kOutdated
  CommandResult resume(AccessRole who, std::uint8_t seat, std::uint32_t number, std::uint32_t there) noexcept {
    if (!latched() || number != stops_) return CommandResult::kOutdated;
    if (!may_end(who, seat)) return CommandResult::kForbidden;
    if (!may_resume(who)) {
      holders_ &= ~(1U << seat);
      if (holders(there) != 0) return CommandResult::kHeldByOthers;
    }
    level_ = Level::kNone;
    holders_ = 0;
    ended_ = {number, seat, who};
    requested_.fill(false);  // a seat that still requests a stop must request it again
    return CommandResult::kDone;
  }

  /// Turns the level in STATE into edges. @return true at a rising edge
  [[nodiscard]] bool rising_edge(std::size_t seat, bool wish) noexcept {
    const bool rose = wish && !requested_[seat];
    requested_[seat] = wish;
    return rose;
  }
  /// Another client has taken the seat.
  void clear_seat(std::size_t seat) noexcept {
    requested_[seat] = false;
    holders_ &= ~(1U << seat);
  }

  /// Restores the latch from a checkpoint. Numbers only grow.
  void restore(Level level, std::uint32_t stops, const Latest& latest) noexcept {
    level_ = level;
    stops_ = stops;
    latest_ = latest;
    holders_ = 0;
    needs_stop_right_ = false;  // the holders are unknown: any seat that may end pauses may end this one
  }

 private:
  bool has_instructor_;
  bool needs_stop_right_ = false;  ///< a role with the full right to stop is among the holders
  Level level_ = Level::kNone;
  std::uint32_t stops_ = 0;
  std::uint32_t holders_ = 0;  ///< seats that hold the pause, bit i for seat i
  Latest latest_;
  Ended ended_;
  std::array<bool, kSeatsMax> requested_{};
};

}  // namespace tandem::server
