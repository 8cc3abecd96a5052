#pragma once

#include <cstdint>
#include <optional>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "proto/wire/wire_messages.h"

namespace tandem::client {

/// Session clock of one seat: the time since the session start on the client's clock [s]. FORCE sets it. Pure: the
/// caller passes the time.
class SessionClock {
 public:
  /// @param tick                period of the session's ticks [s]
  /// @param runs_while_stopped  the scene lets the session clock run while the session is STOPPED or PAUSED
  SessionClock(double tick, bool runs_while_stopped) noexcept : tick_(tick), runs_while_stopped_(runs_while_stopped) {}

  /// Takes a newer FORCE. The clock starts when the session begins, and starts again after each stop, because only the
  /// server knows exactly how long the clock was halted.
  /// @param sent  estimated time at which the server sent `force`
  void on_force(const wire::ForceMessage& force, Time sent) noexcept TANDEM_REALTIME;
  /// Forgets the server's count. `session_time` continues.
  void on_reconnect() noexcept;

  /// True if the clock is halted: the session is STOPPED or PAUSED and its scene does not let the clock run on.
  [[nodiscard]] bool stopped() const noexcept {
    return !runs_while_stopped_ &&
           (session_ == wire::SessionState::kPaused || session_ == wire::SessionState::kStopped);
  }
  /// Time since the session start [s], without the stops that halt the clock; nullopt before the start. Simulated
  /// devices follow it, because a server that restores a checkpoint does not set it back.
  [[nodiscard]] std::optional<double> session_time(Time now) const noexcept;
  /// Session time as the current server counts it [s]: without outages of the server. nullopt until the session runs.
  /// Scripts and screens use it, so that all participants of a session read the same time.
  [[nodiscard]] std::optional<double> server_time(Time now) const noexcept;

 private:
  double tick_;
  bool runs_while_stopped_;
  wire::SessionState session_ = wire::SessionState::kWaiting;
  std::uint32_t session_tick_ = 0;
  std::uint32_t stops_ = 0;          ///< number of stops when the clock was last started
  std::optional<Time> start_;        ///< by the current server's count
  std::optional<Time> first_start_;  ///< by the first server's count; survives server restarts
};

}  // namespace tandem::client
