#include "netsim/system/restart_barrier_checker.h"

namespace tandem::netsim {

void RestartBarrierChecker::check(const server::Session& session, server::Violations& violations) {
  if (session.epoch() != epoch_) {
    epoch_ = session.epoch();
    recovering_ = true;
    for (Seat& seat : seats_) seat.required = seat.led;
  }
  participant_missing_ = false;
  bool engages = false;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    Seat& seat = seats_[i];
    const bool taken = session.seat(i).taken();
    participant_missing_ |= seat.required && !taken;
    engages |= session.seat(i).tx.engage;
    seat.led = recovering_ && seat.required;
    for (std::size_t j = 0; i < scene_->masters() && j < scene_->tools.size(); ++j)
      seat.led |=
          session.tool(j).transfer.scheduled()[i] > 0 && taken && !recovering_ && session.clock().session_tick() > 0;
  }
  if (recovering_ && participant_missing_ && engages) violations.add("gathering", "", session.clock().time(), false);
}

void RestartBarrierChecker::on_audit_event(const server::AuditEvent& event, double t, server::Violations& violations) {
  if (event.what != server::AuditEvent::What::kAllBack) return;
  const bool by_itself = event.seat >= seats_.size();  // otherwise an instructor resumed without the missing seats
  if (recovering_ && by_itself && participant_missing_) violations.add("gathering", "", t, false);
  recovering_ = false;
}

}  // namespace tandem::netsim
