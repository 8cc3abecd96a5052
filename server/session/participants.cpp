#include "server/session/participants.h"

namespace tandem::server {

JoinResult Participants::may_admit(Time now, std::size_t i, bool same_owner) const noexcept {
  if (closing_.session.begun()) return JoinResult::kSessionOver;
  if (i >= seats_.size()) return JoinResult::kNoSuchSeat;
  if (seats_[i].taken() && !same_owner && seats_[i].silence(now) <= kOwnerSilenceMax) return JoinResult::kSeatTaken;
  return JoinResult::kAccepted;
}

JoinResult Participants::admit(Time now, std::size_t i, SeatConnection& entry, bool same_owner) noexcept {
  const JoinResult may = may_admit(now, i, same_owner);
  if (may != JoinResult::kAccepted) return may;
  seats_[i].attach(now, entry);
  closing_.seats[i] = {};
  monitors_[i] = {};
  audit_->emit(now, AuditEvent::What::kJoin, i);
  return may;
}

bool Participants::remove(std::size_t i, wire::CloseReason why) noexcept {
  if (i >= seats_.size() || !seats_[i].taken() || removing(i)) return false;
  closing_.seats[i].begin(why, clock_->dt());
  any_removal_ = true;
  return true;
}

/// The old resume secret is deleted, so that a participant who left or was removed cannot resume.
void Participants::release(Time now, std::size_t i, AuditEvent::What why) noexcept {
  seats_[i].release();
  seats_[i].set_resume({});
  audit_->emit(now, why, i);
}

void Participants::end(wire::CloseReason why) noexcept {
  if (!closing_.session.begun()) closing_.session.begin(why, clock_->dt());
}

void Participants::step(Time now) noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const SeatEndpoint::Condition condition = seats_[i].condition(now);
    ready_[i] = seats_[i].ready(condition);
    const bool felt = seats_[i].receives_force() && !removing(i);
    admissible_[i] = felt && !condition.quarantined;
    present_[i] = felt && seats_[i].present(condition);
    monitors_[i].step(now, i, seats_[i], condition, *audit_);
  }
}

void Participants::step_removals(Time now) noexcept {
  any_removal_ = false;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const bool ends = closing_.seats[i].step();
    any_removal_ |= closing_.seats[i].in_progress();
    if (!ends) continue;
    closing_.seats[i] = {};
    if (seats_[i].taken()) release(now, i, AuditEvent::What::kRemoved);  // else the client left on its own
  }
}

void Participants::reject_forbidden(Time now, std::size_t i) noexcept {
  if (seats_[i].misbehaviour().forbidden_event_due(now)) audit_->emit(now, AuditEvent::What::kForbidden, i);
}

std::uint32_t Participants::connected(Time now) const noexcept {
  std::uint32_t seats = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    seats |= seats_[i].taken() && seats_[i].alive(now) && !removing(i) ? 1U << i : 0U;
  return seats;
}

}  // namespace tandem::server
