#include <algorithm>

#include "server/session.h"

/// Who asks for what, who may, and who is there: the stop lane, the beginning, and what is written down of it.
namespace tandem::server {

namespace {
constexpr Duration kInstructorAway = std::chrono::seconds(10);
constexpr Duration kFaultMemory = std::chrono::seconds(1);
}  // namespace

void Session::note(Time now, AuditEvent::What what, std::size_t seat, std::uint32_t version) noexcept {
  AuditEvent e;
  e.what = what;
  e.seat = static_cast<std::uint8_t>(seat);
  e.version = version;
  e.tick = session_tick_;
  e.at = now;
  audit_.push(e);
}

void Session::hear(Time now, std::size_t i, const SeatPort::Heard& heard) noexcept {
  if (heard.forbidden) forbid(now, i);
  if (heard.acted) hear_wishes(now, i);
  if (heard.authority && !leaving(i)) hear_authority(now, i, *heard.authority);
  if (heard.close) {
    seats_[i].release();
    seats_[i].remember({});  // who left does not come back by the old secret
    note(now, AuditEvent::What::kLeave, i);
  }
}

void Session::forbid(Time now, std::size_t i) noexcept {
  if (seats_[i].conduct().forbidden(now)) note(now, AuditEvent::What::kForbidden, i);
}

void Session::hear_wishes(Time now, std::size_t i) noexcept {
  const wire::StateMessage& said = seats_[i].heard();
  if (stop_lane_.rises(i, said.stop_all)) {
    if (const auto level = stop_lane_.press(now, seats_[i].role(), static_cast<std::uint8_t>(i))) {
      note(now, *level == StopLane::Level::kStopped ? AuditEvent::What::kStop : AuditEvent::What::kPause, i, stop_lane_.stops());
    } else {
      forbid(now, i);
    }
  }
  if (leaving(i)) return;  // who is being let go may still stop, nothing else
  if (said.resume_stop == 0 || said.resume_stop != stop_lane_.stops()) return;
  if (gathering_ && !stop_lane_.on()) {
    if (!stop_lane_.may_resume(seats_[i].role())) return forbid(now, i);
    note(now, AuditEvent::What::kGathered, i, said.resume_stop);
    return go_on(now);
  }
  if (!stop_lane_.on()) return;
  const StopLane::Resume became = stop_lane_.resume(seats_[i].role(), static_cast<std::uint8_t>(i), said.resume_stop, there(now));
  if (became == StopLane::Resume::kEnded) note(now, AuditEvent::What::kResume, i, said.resume_stop);
  if (became == StopLane::Resume::kForbidden) forbid(now, i);
}

bool Session::stop_hands(Time now, AccessRole who, std::uint8_t seat) noexcept { return press_stop(now, who, seat, StopLane::Level::kStopped); }
bool Session::pause_hands(Time now, AccessRole who, std::uint8_t seat) noexcept { return press_stop(now, who, seat, StopLane::Level::kPaused); }

std::uint32_t Session::there(Time now) const noexcept {
  std::uint32_t seats = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) seats |= seats_[i].taken() && seats_[i].alive(now) && !leaving(i) ? 1U << i : 0U;
  return seats;
}

bool Session::press_stop(Time now, AccessRole who, std::uint8_t seat, StopLane::Level wanted) noexcept {
  const auto level = stop_lane_.press(now, who, seat < seats_.size() ? seat : AuditEvent::kControlPlane, wanted);
  if (!level) return false;
  note(now, *level == StopLane::Level::kStopped ? AuditEvent::What::kStop : AuditEvent::What::kPause, AuditEvent::kControlPlane,
       stop_lane_.stops());
  settle_state();
  return true;
}

bool Session::resume_hands(Time now, AccessRole who, std::uint32_t number, std::uint8_t seat) noexcept {
  if (gathering_ && !stop_lane_.on() && number == stop_lane_.stops()) {
    if (!stop_lane_.may_resume(who)) return false;
    note(now, AuditEvent::What::kGathered, AuditEvent::kControlPlane, number);
    go_on(now);
    return true;
  }
  const StopLane::Resume became = stop_lane_.resume(who, seat, number, there(now));
  if (became != StopLane::Resume::kEnded) return became == StopLane::Resume::kOutdated ? stop_lane_.may_resume(who) : became == StopLane::Resume::kOthers;
  note(now, AuditEvent::What::kResume, AuditEvent::kControlPlane, number);
  settle_state();
  return true;
}

/// Who is waited for before the session begins, or goes on.
bool Session::needed(std::size_t i) const noexcept {
  return gathering_ ? awaited_[i] : scene_->seats[i].required;
}

/// After a restart: time goes on from where the checkpoint was; a stop that was on then still is, under a new number.
void Session::go_on(Time now) noexcept {
  gathering_ = false;
  awaited_ = {};
  begun_ = engage_ = true;
  if (stop_before_ != StopLane::Level::kNone) stop_lane_.raise(stop_before_, {});
  settle_state();
  for (auto& s : seats_)
    if (auto* l = s.link()) l->restart_statistics(now);
}

/// Before the session begins: springs may be loaded once everybody needed is ready, and time runs once they are engaged.
void Session::wait_for_people(Time now) noexcept {
  bool all_ready = true, all_there = true;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (!needed(i)) continue;
    all_ready = all_ready && seats_[i].ready(now);
    all_there = all_there && (seats_[i].feels() ? present_[i] : seats_[i].ready(now));
  }
  const bool to_a_stop = gathering_ && stop_before_ != StopLane::Level::kNone;  // nobody is engaged only to be let go
  engage_ = all_ready && !to_a_stop;
  if (!all_ready || !(all_there || to_a_stop) || lets_go()) return;
  if (gathering_) {
    note(now, AuditEvent::What::kGathered, AuditEvent::kNoSeat);
    return go_on(now);
  }
  begun_ = true;
  session_tick_ = 0;
  for (auto& s : seats_)
    if (auto* l = s.link()) l->restart_statistics(now);
}

void Session::look_after_people(Time now) noexcept {
  if (begun_ && relief_.passive != passive_) {
    passive_ = relief_.passive;
    note(now, passive_ ? AuditEvent::What::kPassive : AuditEvent::What::kInTime, AuditEvent::kNoSeat);
  }
  for (std::size_t i = 0; i < seats_.size(); ++i) look_after(now, i);
  std::uint64_t not_finite = 0;
  for (const Tool& tool : tools_) not_finite += tool.not_finite();
  if (not_finite == not_finite_) return;
  not_finite_ = not_finite;
  // Once may be a reading that was no number; twice within a second nobody can trust this session's numbers any more.
  const bool again = last_fault_ && now - *last_fault_ < kFaultMemory;
  last_fault_ = now;
  if (!again || stop_lane_.level() == StopLane::Level::kStopped) return;
  stop_lane_.raise(StopLane::Level::kStopped, {StopLane::Level::kStopped, StopLane::kNobody, AccessRole::kObserver, now});
  note(now, AuditEvent::What::kFault, AuditEvent::kNoSeat, stop_lane_.stops());
}

void Session::look_after(Time now, std::size_t i) noexcept {
  SeatPort& seat = seats_[i];
  Watch& was = watch_[i];
  if (!seat.taken() || !seat.alive_once()) return;
  const auto changed = [&](bool& before, bool is, AuditEvent::What begins, AuditEvent::What ends) {
    if (before == is) return;
    before = is;
    note(now, is ? begins : ends, i);
  };
  const bool lost_before = was.lost;
  changed(was.lost, !seat.alive(now) || seat.deaf(), AuditEvent::What::kLoss, AuditEvent::What::kBack);
  changed(was.isolated, seat.conduct().isolated(now), AuditEvent::What::kIsolated, AuditEvent::What::kReadmitted);
  changed(was.own_stop, seat.heard().stop, AuditEvent::What::kOwnStop, AuditEvent::What::kOwnResume);
  if (seat.poll_flood()) note(now, AuditEvent::What::kFlood, i);
  if (was.lost && !lost_before) was.lost_at = now;
  was.away = was.away && was.lost;
  if (was.lost && !was.away && seat.role() == AccessRole::kInstructor && now - was.lost_at >= kInstructorAway) {
    was.away = true;
    note(now, AuditEvent::What::kInstructorAway, i);
  }
}

}  // namespace tandem::server
