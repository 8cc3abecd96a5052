#include "server/session/session_lifecycle.h"

#include <algorithm>

namespace tandem::server {

void SessionLifecycle::report_overload(Time now) noexcept {
  if (!clock_->begun() || load_state_.overloaded == overloaded_) return;
  overloaded_ = load_state_.overloaded;
  audit_->emit(now, overloaded_ ? AuditEvent::What::kOverload : AuditEvent::What::kOverloadCleared,
               AuditEvent::kNoSeat);
}

void SessionLifecycle::step(Time now, std::span<const Tool> tools) noexcept {
  if (ending()) return participants_->step_end();
  if (!clock_->begun()) {
    if (start_->step(now, disengages_all()))
      start_->recovering() ? stop_->resume_after_restart(now, AuditEvent::kNoSeat, 0) : start_->begin(now);
  } else {
    clock_->advance(clock_stopped());
    held_ = std::ranges::all_of(tools, [](const Tool& t) { return t.authority.held(); });
  }
  if (clock_->begun() && clock_->time() >= scene_->duration) participants_->end(wire::CloseReason::kDone);
}

wire::SessionState SessionLifecycle::state() const noexcept {
  if (ending()) return wire::SessionState::kEnding;
  if (stop_->latch().level() == StopLatch::Level::kStopped) return wire::SessionState::kStopped;
  if (stop_->latch().level() == StopLatch::Level::kPaused) return wire::SessionState::kPaused;
  return !clock_->begun()         ? wire::SessionState::kWaiting
         : load_state_.overloaded ? wire::SessionState::kOverloaded
         : held_                  ? wire::SessionState::kHeld
                                  : wire::SessionState::kRunning;
}

}  // namespace tandem::server
