#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "common/base/time.h"

namespace tandem::server {

/// Two counts of ticks. The server's ticks follow the time that the caller passes, to within one. The session's ticks
/// begin when all required seats are engaged, and rest while the session is stopped.
class SessionClock {
 public:
  static constexpr std::uint32_t kCatchUpMax = 50;  ///< missed ticks that are run after a stall; more are dropped

  static constexpr std::uint32_t kTickMax = std::numeric_limits<std::uint32_t>::max();  ///< last session tick

  /// @param tick_hz  ticks per second, positive
  explicit SessionClock(double tick_hz) noexcept : dt_(1.0 / tick_hz), tick_length_(from_seconds(dt_)) {}

  [[nodiscard]] double dt() const noexcept { return dt_; }  ///< tick [s]
  [[nodiscard]] Duration tick_length() const noexcept { return tick_length_; }

  /// Begins the server's tick at `now`.
  /// @param missed  ticks whose time passed without a call
  /// @return number of missed ticks to run now, at most kCatchUpMax
  std::uint32_t begin_tick(Time now, std::uint32_t missed) noexcept {
    if (started_) {
      // A turn near the middle between two ticks may be rounded to the number of the tick before. The number decides
      // which datagrams are due, so no two ticks have the same.
      const auto by_time = static_cast<std::uint32_t>(std::llround(seconds(now - *started_) / dt_));
      tick_ += static_cast<std::uint32_t>(std::max(1, static_cast<std::int32_t>(by_time - tick_)));
    } else {
      started_ = now;
    }
    last_tick_ = now;
    const std::uint32_t run = std::min(missed, kCatchUpMax);
    dropped_ticks_ += missed - run;
    return run;
  }
  /// Begins one of the ticks to run. @return time since the one before; 0 for the first
  [[nodiscard]] Duration begin_step() noexcept { return std::exchange(step_, tick_length_); }
  /// Number of the server's tick; 0 for the first.
  [[nodiscard]] std::uint32_t tick() const noexcept { return tick_; }
  /// A tick began already.
  [[nodiscard]] bool ticked() const noexcept { return started_.has_value(); }
  [[nodiscard]] Time last_tick() const noexcept { return last_tick_; }
  /// Time from the server's first tick to the last one.
  [[nodiscard]] Duration elapsed() const noexcept { return started_ ? last_tick_ - *started_ : Duration{0}; }
  /// Missed ticks that were not run.
  [[nodiscard]] std::uint64_t dropped_ticks() const noexcept { return dropped_ticks_; }

  /// Sets the session's tick, from a checkpoint. The clock does not run yet.
  void restore(std::uint32_t session_tick) noexcept { session_tick_ = session_tick; }
  /// Lets the session's ticks run: from 0, or on from the restored tick.
  void begin() noexcept {
    begun_ = true;
    session_tick_ = 0;
  }
  void resume() noexcept { begun_ = true; }
  /// Counts one tick. The count ends at kTickMax, where session time stands still: it never begins again at 0, which
  /// would repeat the timeline. @pre begun()
  void advance(bool stopped) noexcept {
    if (stopped) {
      ++stopped_ticks_;
    } else if (session_tick_ < kTickMax) {
      ++session_tick_;
    }
  }
  [[nodiscard]] bool begun() const noexcept { return begun_; }
  [[nodiscard]] std::uint32_t session_tick() const noexcept { return session_tick_; }
  /// Session time [s]: ticks since `begin`, without those for which the clock was stopped.
  [[nodiscard]] double time() const noexcept { return session_tick_ * dt_; }
  /// Ticks of this epoch for which the clock was stopped.
  [[nodiscard]] std::uint64_t stopped_ticks() const noexcept { return stopped_ticks_; }

 private:
  double dt_;
  Duration tick_length_, step_{0};
  std::optional<Time> started_;  ///< first tick
  Time last_tick_{};
  std::uint32_t tick_ = 0, session_tick_ = 0;
  std::uint64_t dropped_ticks_ = 0, stopped_ticks_ = 0;
  bool begun_ = false;
};

}  // namespace tandem::server
