#include "server/session/seat_monitor.h"

namespace tandem::server {

void SeatMonitor::step(Time now, std::size_t number, SeatEndpoint& seat, const SeatEndpoint::Condition& condition,
                       AuditTrail& audit) noexcept {
  using What = AuditEvent::What;
  if (!seat.taken() || !seat.ever_heard()) return;
  const auto changed = [&](bool& before, bool is, What begins, What ends) {
    if (before == is) return false;
    before = is;
    audit.emit(now, is ? begins : ends, number);
    return true;
  };
  if (changed(lost_, condition.lost, What::kLoss, What::kBack)) lost_at_ = now;
  changed(quarantined_, condition.quarantined, What::kQuarantined, What::kCleared);
  changed(local_stop_, seat.last_state().stop, What::kLocalStop, What::kLocalResume);
  if (seat.poll_flood()) audit.emit(now, What::kFlood, number);
  away_ = away_ && lost_;
  if (!lost_ || away_ || seat.role() != AccessRole::kInstructor || now - lost_at_ < kInstructorAway) return;
  away_ = true;
  audit.emit(now, What::kInstructorAway, number);
}

}  // namespace tandem::server
