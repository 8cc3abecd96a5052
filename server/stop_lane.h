#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "server/roles.h"

namespace tandem::server {

/// The session's stop: latched, numbered, ended by a person who names the newest number, so that an old wish never undoes a newer
/// stop. While it is on nobody is engaged.
///
/// Who may stop may end it. A pause of those who may only pause is ended by them too where the scene has no instructor's seat (nobody
/// else would be there to do it): each takes back his own, and when nobody's is left it is over. A pause of somebody who is not there any
/// more holds nobody up.
class StopLane {
 public:
  enum class Level : std::uint8_t { kNone, kPaused, kStopped };
  static constexpr std::uint8_t kNobody = 255;  ///< instead of a seat

  /// @param led  the scene has an instructor's seat
  explicit StopLane(bool led = true) noexcept : led_(led) {}

  /// Who raised it last.
  struct Newest {
    Level level = Level::kNone;  ///< kNone: nobody since this server began
    std::uint8_t by = kNobody;   ///< a seat, or AuditEvent::kControlPlane; kNobody: the session itself
    AccessRole role = AccessRole::kObserver;
    Time at{};
  };

  /// Who ended a stop last.
  struct Ended {
    std::uint32_t number = 0;    ///< of the stop; 0: nobody since this server began
    std::uint8_t by = kNobody;   ///< a seat, or AuditEvent::kControlPlane
    AccessRole role = AccessRole::kObserver;
  };
  [[nodiscard]] const Ended& ended() const noexcept { return ended_; }

  [[nodiscard]] Level level() const noexcept { return level_; }
  [[nodiscard]] bool on() const noexcept { return level_ != Level::kNone; }
  [[nodiscard]] bool led() const noexcept { return led_; }
  /// How many so far: the number of the newest.
  [[nodiscard]] std::uint32_t stops() const noexcept { return stops_; }
  [[nodiscard]] const Newest& newest() const noexcept { return newest_; }

  /// Whoever wants a stop gets what his role may: @return the level asked for, nothing if he may not
  /// @param by  his seat, or AuditEvent::kControlPlane  @param wanted  at most
  std::optional<Level> press(Time now, AccessRole who, std::uint8_t by, Level wanted = Level::kStopped) noexcept {
    const Grant grant = allowed(who, Right::kStopSession);
    if (grant == Grant::kNo) return std::nullopt;
    const Level level = grant == Grant::kYes ? wanted : Level::kPaused;
    const bool his_own = grant == Grant::kPart && by < kSeatsMax;
    const std::uint32_t held = on() ? holders_ : 0;
    const bool bound = on() && bound_;
    raise(level, {level, by, who, now});
    holders_ = his_own ? held | 1U << by : held;
    bound_ = bound || !his_own;
    return level;
  }
  /// Of the session itself, when it cannot trust its numbers, or goes on from a stop. A stop never becomes a mere pause.
  void raise(Level level, const Newest& newest) noexcept {
    holders_ = on() ? holders_ : 0;
    bound_ = on() && bound_;
    level_ = level > level_ ? level : level_;
    newest_ = newest;
    ++stops_;
  }

  /// Whether his role ends any stop.
  [[nodiscard]] static bool may_resume(AccessRole who) noexcept { return allowed(who, Right::kStopSession) == Grant::kYes; }
  /// Whether those who paused may end this themselves.
  [[nodiscard]] bool own() const noexcept { return level_ == Level::kPaused && !led_ && !bound_; }
  /// Seats whose pause is on, bit i: seat i. @param there  seats that are heard
  [[nodiscard]] std::uint32_t holders(std::uint32_t there) const noexcept { return on() ? holders_ & there : 0; }
  [[nodiscard]] bool may_end(AccessRole who, std::uint8_t seat) const noexcept {
    return may_resume(who) || (own() && seat < kSeatsMax && allowed(who, Right::kEndPause) != Grant::kNo);
  }
  /// Whether he has something to end: any stop, a pause of his own, or one that nobody who is there holds any more.
  [[nodiscard]] bool awaits(AccessRole who, std::uint8_t seat, std::uint32_t there) const noexcept {
    return on() && may_end(who, seat) && (may_resume(who) || holders(there) == 0 || (holders(there) >> seat & 1U) != 0);
  }

  enum class Resume : std::uint8_t {
    kEnded,
    kOthers,     ///< his own pause is taken back, others' are still on
    kForbidden,
    kOutdated,   ///< nothing is stopped, or it is not the newest that he names
  };
  Resume resume(AccessRole who, std::uint8_t seat, std::uint32_t number, std::uint32_t there) noexcept {
    if (!on() || number != stops_) return Resume::kOutdated;
    if (!may_end(who, seat)) return Resume::kForbidden;
    if (!may_resume(who)) {
      holders_ &= ~(1U << seat);
      if (holders(there) != 0) return Resume::kOthers;
    }
    level_ = Level::kNone;
    holders_ = 0;
    ended_ = {number, seat, who};
    wishes_.fill(false);  // who still wishes a stop, wishes it anew
    return Resume::kEnded;
  }

  /// A seat's level on the wire becomes presses. @return whether this is one
  [[nodiscard]] bool rises(std::size_t seat, bool wish) noexcept {
    const bool rose = wish && !wishes_[seat];
    wishes_[seat] = wish;
    return rose;
  }
  /// Another client sits there now.
  void forget(std::size_t seat) noexcept {
    wishes_[seat] = false;
    holders_ &= ~(1U << seat);
  }

  /// As a checkpoint remembers it; the number only grows.
  void restore(Level level, std::uint32_t stops) noexcept {
    level_ = level;
    stops_ = stops;
    holders_ = 0;
    bound_ = false;  // who made it is not known any more: of a pause everybody who may pause is an heir
  }

 private:
  bool led_;
  bool bound_ = false;          ///< not only of those who may do no more than pause
  Level level_ = Level::kNone;
  std::uint32_t stops_ = 0;
  std::uint32_t holders_ = 0;   ///< seats whose pause is on
  Newest newest_;
  Ended ended_;
  std::array<bool, kSeatsMax> wishes_{};
};

}  // namespace tandem::server
