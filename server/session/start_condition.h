#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "proto/spec/scene_spec.h"
#include "server/session/checkpoint.h"
#include "server/session/seat_endpoint.h"
#include "server/session/session_clock.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// Decides when a session begins, and when it resumes after a restart of its server.
///
/// A session waits for its required seats. Springs may be loaded once all of them are ready; the session begins once
/// all of them are engaged. After a restart the required seats are the taken instructors' seats and the taken seats
/// with authority, instead of those that the scene names.
class StartCondition {
 public:
  /// @param present  seats whose springs may act on tools
  /// All arguments must outlive this.
  StartCondition(const SceneSpec& scene, std::span<SeatEndpoint> seats, const std::array<bool, kSeatsMax>& present,
                 SessionClock& clock) noexcept;
  /// Waits for the required seats of the checkpoint, if its session had begun.
  void restore(const Checkpoint& from) noexcept;
  /// Writes whether the session had begun, and the seats that a restart may wait for: those that are taken or awaited.
  void save(Checkpoint& to) const noexcept TANDEM_REALTIME;

  /// Updates `may_engage`. @pre the session has not begun
  /// @param disengaged  no seat may be engaged now
  /// @return true if the session can begin, or resume after a restart, in this tick
  [[nodiscard]] bool step(Time now, bool disengaged) noexcept TANDEM_REALTIME;
  /// Lets the session's ticks run, from 0 or after a restart from the checkpoint. Link statistics start from zero.
  void begin(Time now) noexcept;

  /// The session waits for this seat.
  [[nodiscard]] bool required(std::size_t seat) const noexcept {
    return recovering_ ? required_for_resume_[seat] : scene_->seats[seat].required;
  }
  /// Required seats that are not ready.
  [[nodiscard]] std::vector<std::size_t> missing(Time now) const;
  /// True once session time runs, or if it ran before a restart.
  [[nodiscard]] bool begun() const noexcept { return clock_->begun() || recovering_; }
  /// True after a restore until all required seats are ready, or until an instructor or operator resumes without them.
  [[nodiscard]] bool recovering() const noexcept { return recovering_; }
  /// All required seats are ready: springs may be loaded.
  [[nodiscard]] bool may_engage() const noexcept { return may_engage_; }
  /// Level that was latched when the last server failed.
  [[nodiscard]] StopLatch::Level stop_before() const noexcept { return stop_before_; }

 private:
  const SceneSpec* scene_;
  std::span<SeatEndpoint> seats_;
  const std::array<bool, kSeatsMax>* present_;
  SessionClock* clock_;
  bool may_engage_ = false, recovering_ = false;
  std::array<bool, kSeatsMax> required_for_resume_{};  ///< while recovering
  StopLatch::Level stop_before_ = StopLatch::Level::kNone;
};

}  // namespace tandem::server
