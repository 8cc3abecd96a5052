#include <algorithm>

#include "server/session/session.h"

/// Requests by STATE and by command, presence of participants, stop and resume, the start of the session, and their
/// audit events.
namespace tandem::server {

namespace {
constexpr Duration kInstructorAway = std::chrono::seconds(10);
constexpr Duration kFaultMemory = std::chrono::seconds(1);
}  // namespace

void Session::emit_event(Time now, AuditEvent::What what, std::size_t seat, std::uint32_t version) noexcept {
  AuditEvent e;
  e.what = what;
  e.seat = static_cast<std::uint8_t>(seat);
  e.version = version;
  e.tick = session_tick_;
  e.at = now;
  audit_.push(e);
}

void Session::handle_message(Time now, std::size_t i, const SeatEndpoint::Received& heard) noexcept {
  if (heard.forbidden) reject_forbidden(now, i);
  if (heard.accepted_state) handle_requests(now, i);
  if (heard.authority && !closing_out(i)) handle_authority_request(now, i, *heard.authority);
  if (heard.close) {
    seats_[i].release();
    seats_[i].set_resume({});  // a client that left cannot resume with the old secret
    emit_event(now, AuditEvent::What::kLeave, i);
  }
}

void Session::reject_forbidden(Time now, std::size_t i) noexcept {
  if (seats_[i].misbehaviour().forbidden_event_due(now)) emit_event(now, AuditEvent::What::kForbidden, i);
}

void Session::handle_requests(Time now, std::size_t i) noexcept {
  const wire::StateMessage& said = seats_[i].last_state();
  if (stop_latch_.rising_edge(i, said.stop_all)) {
    if (const auto level = stop_latch_.request(now, seats_[i].role(), static_cast<std::uint8_t>(i))) {
      emit_event(now, *level == StopLatch::Level::kStopped ? AuditEvent::What::kStop : AuditEvent::What::kPause, i,
                 stop_latch_.stops());
    } else {
      reject_forbidden(now, i);
    }
  }
  if (closing_out(i)) return;  // a participant who is being removed may stop, nothing else
  if (said.resume_stop == 0 || said.resume_stop != stop_latch_.stops()) return;
  if (recovering_ && !stop_latch_.latched()) {
    if (!stop_latch_.may_resume(seats_[i].role())) return reject_forbidden(now, i);
    emit_event(now, AuditEvent::What::kAllBack, i, said.resume_stop);
    return resume_after_restart(now);
  }
  if (!stop_latch_.latched()) return;
  const StopLatch::Resume became =
      stop_latch_.resume(seats_[i].role(), static_cast<std::uint8_t>(i), said.resume_stop, connected_seats(now));
  if (became == StopLatch::Resume::kEnded) emit_event(now, AuditEvent::What::kResume, i, said.resume_stop);
  if (became == StopLatch::Resume::kForbidden) reject_forbidden(now, i);
}

bool Session::stop(Time now, AccessRole who, std::uint8_t seat) noexcept {
  return request_stop(now, who, seat, StopLatch::Level::kStopped);
}
bool Session::pause(Time now, AccessRole who, std::uint8_t seat) noexcept {
  return request_stop(now, who, seat, StopLatch::Level::kPaused);
}

std::uint32_t Session::connected_seats(Time now) const noexcept {
  std::uint32_t seats = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    seats |= seats_[i].taken() && seats_[i].alive(now) && !closing_out(i) ? 1U << i : 0U;
  return seats;
}

bool Session::request_stop(Time now, AccessRole who, std::uint8_t seat, StopLatch::Level wanted) noexcept {
  const auto level = stop_latch_.request(now, who, seat < seats_.size() ? seat : AuditEvent::kControlPlane, wanted);
  if (!level) return false;
  emit_event(now, *level == StopLatch::Level::kStopped ? AuditEvent::What::kStop : AuditEvent::What::kPause,
             AuditEvent::kControlPlane, stop_latch_.stops());
  derive_session_state();
  return true;
}

bool Session::resume(Time now, AccessRole who, std::uint32_t number, std::uint8_t seat) noexcept {
  if (recovering_ && !stop_latch_.latched() && number == stop_latch_.stops()) {
    if (!stop_latch_.may_resume(who)) return false;
    emit_event(now, AuditEvent::What::kAllBack, AuditEvent::kControlPlane, number);
    resume_after_restart(now);
    return true;
  }
  const StopLatch::Resume became = stop_latch_.resume(who, seat, number, connected_seats(now));
  if (became != StopLatch::Resume::kEnded)
    return became == StopLatch::Resume::kOutdated ? stop_latch_.may_resume(who)
                                                  : became == StopLatch::Resume::kHeldByOthers;
  emit_event(now, AuditEvent::What::kResume, AuditEvent::kControlPlane, number);
  derive_session_state();
  return true;
}

bool Session::is_required(std::size_t i) const noexcept {
  return recovering_ ? required_for_resume_[i] : scene_->seats[i].required;
}

/// Resumes after a restart. Time continues from the checkpoint; a stop that was on then is raised again, under a new
/// number.
void Session::resume_after_restart(Time now) noexcept {
  recovering_ = false;
  required_for_resume_ = {};
  begun_ = engage_ = true;
  if (stop_before_ != StopLatch::Level::kNone) stop_latch_.raise(stop_before_, {});
  derive_session_state();
  for (auto& s : seats_)
    if (auto* l = s.link()) l->restart_statistics(now);
}

/// Checks whether the session can start. Springs may be loaded when all required seats are ready; time runs when they
/// are engaged.
void Session::check_start_condition(Time now) noexcept {
  bool all_ready = true, all_there = true;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (!is_required(i)) continue;
    all_ready = all_ready && seats_[i].ready(now);
    all_there = all_there && (seats_[i].receives_force() ? present_[i] : seats_[i].ready(now));
  }
  // No seat is engaged only to be released at once.
  const bool to_a_stop = recovering_ && stop_before_ != StopLatch::Level::kNone;
  engage_ = all_ready && !to_a_stop;
  if (!all_ready || !(all_there || to_a_stop) || disengages_all()) return;
  if (recovering_) {
    emit_event(now, AuditEvent::What::kAllBack, AuditEvent::kNoSeat);
    return resume_after_restart(now);
  }
  begun_ = true;
  session_tick_ = 0;
  for (auto& s : seats_)
    if (auto* l = s.link()) l->restart_statistics(now);
}

void Session::monitor_seats(Time now) noexcept {
  if (begun_ && load_state_.overloaded != overloaded_) {
    overloaded_ = load_state_.overloaded;
    emit_event(now, overloaded_ ? AuditEvent::What::kOverload : AuditEvent::What::kOverloadCleared,
               AuditEvent::kNoSeat);
  }
  for (std::size_t i = 0; i < seats_.size(); ++i) monitor_seat(now, i);
  std::uint64_t not_finite = 0;
  for (const Tool& tool : tools()) not_finite += tool.not_finite();
  if (not_finite == not_finite_) return;
  not_finite_ = not_finite;
  // One non-finite result may be a bad reading. Two within a second show a fault, so the session stops.
  const bool again = last_fault_ && now - *last_fault_ < kFaultMemory;
  last_fault_ = now;
  if (!again || stop_latch_.level() == StopLatch::Level::kStopped) return;
  stop_latch_.raise(StopLatch::Level::kStopped,
                    {StopLatch::Level::kStopped, StopLatch::kNoSeat, AccessRole::kObserver, now});
  emit_event(now, AuditEvent::What::kFault, AuditEvent::kNoSeat, stop_latch_.stops());
}

void Session::monitor_seat(Time now, std::size_t i) noexcept {
  SeatEndpoint& seat = seats_[i];
  SeatMonitorState& was = seat_monitor_[i];
  if (!seat.taken() || !seat.ever_heard()) return;
  const auto changed = [&](bool& before, bool is, AuditEvent::What begins, AuditEvent::What ends) {
    if (before == is) return;
    before = is;
    emit_event(now, is ? begins : ends, i);
  };
  const bool lost_before = was.lost;
  changed(was.lost, !seat.alive(now) || seat.one_way(), AuditEvent::What::kLoss, AuditEvent::What::kBack);
  changed(was.quarantined, seat.misbehaviour().quarantined(now), AuditEvent::What::kQuarantined,
          AuditEvent::What::kCleared);
  changed(was.local_stop, seat.last_state().stop, AuditEvent::What::kLocalStop, AuditEvent::What::kLocalResume);
  if (seat.poll_flood()) emit_event(now, AuditEvent::What::kFlood, i);
  if (was.lost && !lost_before) was.lost_at = now;
  was.away = was.away && was.lost;
  if (was.lost && !was.away && seat.role() == AccessRole::kInstructor && now - was.lost_at >= kInstructorAway) {
    was.away = true;
    emit_event(now, AuditEvent::What::kInstructorAway, i);
  }
}

}  // namespace tandem::server
