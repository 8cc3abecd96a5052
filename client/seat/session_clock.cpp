#include "client/seat/session_clock.h"

namespace tandem::client {

void SessionClock::on_force(const wire::ForceMessage& force, Time sent) noexcept {
  session_ = force.session;
  session_tick_ = force.session_tick;
  if (stopped()) return;
  const bool runs = session_ == wire::SessionState::kRunning;
  const bool restarts = start_ && force.stops != stops_ && !runs_while_stopped_ &&
                        (runs || session_ == wire::SessionState::kHeld || session_ == wire::SessionState::kOverloaded);
  if (!restarts && (start_ || !runs)) return;
  const Time start = sent - from_seconds(session_tick_ * tick_);
  if (restarts) *first_start_ += start - *start_;
  start_ = start;
  stops_ = force.stops;
  if (!first_start_) first_start_ = start_;
}

void SessionClock::on_reconnect() noexcept {
  session_ = wire::SessionState::kWaiting;
  session_tick_ = 0;
  start_.reset();
}

std::optional<double> SessionClock::session_time(Time now) const noexcept {
  if (!first_start_ || (stopped() && !start_)) return std::nullopt;
  if (stopped()) return session_tick_ * tick_ + seconds(*start_ - *first_start_);
  return seconds(now - *first_start_);
}

std::optional<double> SessionClock::server_time(Time now) const noexcept {
  if (!start_) return std::nullopt;
  return stopped() ? session_tick_ * tick_ : seconds(now - *start_);
}

}  // namespace tandem::client
