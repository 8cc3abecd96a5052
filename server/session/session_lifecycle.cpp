#include "server/session/session_lifecycle.h"

#include <algorithm>

namespace tandem::server {

void SessionLifecycle::report_changes(Time now) noexcept {
  using What = AuditEvent::What;
  if (!clock_->begun()) return;
  if (load_state_.overloaded != overloaded_) {
    overloaded_ = load_state_.overloaded;
    audit_->emit(now, overloaded_ ? What::kOverload : What::kOverloadCleared, AuditEvent::kNoSeat);
  }
  if (may_act_ != acts_) {
    acts_ = may_act_;
    audit_->emit(now, acts_ ? What::kLeaseRenewed : What::kLeaseDoubtful, AuditEvent::kNoSeat);
  }
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
         : held_ || !may_act_     ? wire::SessionState::kHeld
                                  : wire::SessionState::kRunning;
}

}  // namespace tandem::server
