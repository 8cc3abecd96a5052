#include "server/session/stop_control.h"

#include <algorithm>

namespace tandem::server {

void StopControl::restore(const Checkpoint& from, Time saved_at) noexcept {
  before_ = from.latest_stop;
  before_.at = saved_at + (before_.at - Time{});
  before_.restored = true;
  restores_ = from.restores;
  if (restores_) {
    ++(from.handed_over ? restores_->moves : restores_->restarts);
    restores_->numbers += start_->recovering() ? 1 : 0;
  }
  if (start_->recovering()) {
    // A new number, which an instructor can name to resume without the missing seats.
    latch_.restore(StopLatch::Level::kNone, from.stops + 1, before_);
  } else {
    latch_.restore(from.stop, from.stops, before_);
  }
}

void StopControl::save(Checkpoint& to, Time now) const noexcept {
  to.stops = latch_.stops();
  to.restores = restores_;
  to.orders = orders_;
  to.stop = start_->recovering() ? std::max(start_->stop_before(), latch_.level()) : latch_.level();
  const bool raised_later = start_->recovering() && start_->stop_before() > latch_.level();
  to.latest_stop = raised_later ? before_ : latch_.latest();
  to.latest_stop.at = Time{} - std::max(Duration{0}, now - to.latest_stop.at);
}

std::optional<StopLatch::Level> StopControl::request(Time now, const Requester& by, StopLatch::Level wanted,
                                                     const StopLatch::Words& words) noexcept {
  const auto level =
      latch_.request(now, by.role, by.seat < seats_ ? by.seat : AuditEvent::kControlPlane, wanted, words);
  if (!level) return level;
  ++orders_;
  audit_->emit(now, *level == StopLatch::Level::kStopped ? AuditEvent::What::kStop : AuditEvent::What::kPause,
               by.audited_as, latch_.stops());
  return level;
}

CommandResult StopControl::resume(Time now, const Requester& by, std::uint32_t number) noexcept {
  if (start_->recovering() && !latch_.latched() && number == latch_.stops()) {
    if (!StopLatch::may_resume(by.role)) return CommandResult::kForbidden;
    resume_after_restart(now, by.audited_as, number);
    ++orders_;
    return CommandResult::kDone;
  }
  const CommandResult became = latch_.resume(by.role, by.seat, number, participants_->connected(now));
  if (became != CommandResult::kDone) return became;
  ++orders_;
  audit_->emit(now, AuditEvent::What::kResume, by.audited_as, number);
  return became;
}

void StopControl::resume_after_restart(Time now, std::uint8_t seat, std::uint32_t number) noexcept {
  audit_->emit(now, AuditEvent::What::kAllBack, seat, number);
  start_->begin(now);
  if (start_->stop_before() == StopLatch::Level::kNone) return;
  latch_.raise(start_->stop_before(), before_);
  if (restores_) ++restores_->numbers;
}

void StopControl::stop_for_fault(Time now) noexcept {
  if (latch_.level() == StopLatch::Level::kStopped) return;
  latch_.raise(StopLatch::Level::kStopped,
               {StopLatch::Level::kStopped, StopLatch::kNoSeat, AccessRole::kObserver, now});
  audit_->emit(now, AuditEvent::What::kFault, AuditEvent::kNoSeat, latch_.stops());
}

}  // namespace tandem::server
