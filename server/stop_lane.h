#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/base/axes.h"
#include "server/roles.h"

namespace tandem::server {

/// The session's stop: latched, numbered, ended by a person who names the newest number, so that an old wish never undoes a newer
/// stop. While it is on nobody is engaged.
class StopLane {
 public:
  enum class Level : std::uint8_t { kNone, kPaused, kStopped };

  [[nodiscard]] Level level() const noexcept { return level_; }
  [[nodiscard]] bool on() const noexcept { return level_ != Level::kNone; }
  /// How many so far: the number of the newest.
  [[nodiscard]] std::uint32_t stops() const noexcept { return stops_; }

  /// Whoever wants a stop gets what his role may: @return the level asked for, nothing if he may not
  /// @param wanted  at most
  std::optional<Level> press(AccessRole who, Level wanted = Level::kStopped) noexcept {
    const Grant grant = allowed(who, Right::kStopSession);
    if (grant == Grant::kNo) return std::nullopt;
    const Level level = grant == Grant::kYes ? wanted : Level::kPaused;
    raise(level);
    return level;
  }
  /// Also of the session itself, when it cannot trust its numbers. A stop never becomes a mere pause.
  void raise(Level level) noexcept {
    level_ = level > level_ ? level : level_;
    ++stops_;
  }
  [[nodiscard]] bool may_resume(AccessRole who) const noexcept { return allowed(who, Right::kStopSession) == Grant::kYes; }
  /// @return whether it ended the stop
  bool resume(AccessRole who, std::uint32_t number) noexcept {
    if (!on() || number != stops_ || !may_resume(who)) return false;
    level_ = Level::kNone;
    wishes_.fill(false);  // who still wishes a stop, wishes it anew
    return true;
  }

  /// A seat's level on the wire becomes presses. @return whether this is one
  [[nodiscard]] bool rises(std::size_t seat, bool wish) noexcept {
    const bool rose = wish && !wishes_[seat];
    wishes_[seat] = wish;
    return rose;
  }
  /// Another client sits there now.
  void forget(std::size_t seat) noexcept { wishes_[seat] = false; }

  /// As a checkpoint remembers it; the number only grows.
  void restore(Level level, std::uint32_t stops) noexcept {
    level_ = level;
    stops_ = stops;
  }

 private:
  Level level_ = Level::kNone;
  std::uint32_t stops_ = 0;
  std::array<bool, kSeatsMax> wishes_{};
};

}  // namespace tandem::server
