#include "server/command.h"

#include "server/session.h"

namespace tandem::server {
namespace {

using Result = Outcome::Result;

/// Somebody who speaks for a seat has its rights as long as it is his.
bool still_his(const Session& session, const Command& command) noexcept {
  if (command.seat == AuditEvent::kNoSeat) return true;
  if (command.seat >= session.scene().seats.size() || session.leaving(command.seat)) return false;
  const link::Link* const link = session.seat(command.seat).link();
  return link != nullptr && link->own_cid() == command.cid;
}

Result resume(Session& session, Time now, const Command& command) noexcept {
  const bool stopped = session.stop_level() != StopLane::Level::kNone;
  if (!stopped && !session.gathering()) return Result::kNothing;
  if (command.number != session.stops()) return Result::kOutdated;
  if (!session.resume_hands(now, command.who, command.number, command.seat)) return Result::kForbidden;
  return session.stop_lane().on() && command.number == session.stops() ? Result::kOthers : Result::kDone;
}

Result set_authority(Session& session, Time now, const Command& command) noexcept {
  if (command.wish.tool >= session.scene().tools.size() || command.wish.masters != session.scene().masters()) return Result::kWrong;
  switch (session.set_authority(now, command.who, command.seat, AuditEvent::kControlPlane, command.wish)) {
    case Session::AuthorityResult::kAnnounced:
      return Result::kDone;
    case Session::AuthorityResult::kOutdated:
      return Result::kOutdated;
    case Session::AuthorityResult::kForbidden:
      return Result::kForbidden;
    case Session::AuthorityResult::kOutOfTouch:
      return Result::kOutOfTouch;
    case Session::AuthorityResult::kWrong:
      break;
  }
  return Result::kWrong;
}

Result remove(Session& session, const Command& command) noexcept {
  if (command.whom >= session.scene().seats.size()) return Result::kWrong;
  const link::Link* const link = session.seat(command.whom).link();
  if (link == nullptr || (command.whom_cid != 0 && link->own_cid() != command.whom_cid)) return Result::kNothing;
  return session.dismiss(command.whom, command.why) ? Result::kDone : Result::kNothing;
}

Result obey(Session& session, Time now, const Command& command) noexcept {
  switch (command.what) {
    case Command::What::kLook:
      return Result::kDone;
    case Command::What::kStop:
      return session.stop_hands(now, command.who, command.seat) ? Result::kDone : Result::kForbidden;
    case Command::What::kPause:
      return session.pause_hands(now, command.who, command.seat) ? Result::kDone : Result::kForbidden;
    case Command::What::kResume:
      return resume(session, now, command);
    case Command::What::kSetAuthority:
      return set_authority(session, now, command);
    case Command::What::kRemove:
      return remove(session, command);
  }
  return Result::kWrong;
}

}  // namespace

Outcome carry_out(Session& session, Time now, const Command& command) noexcept {
  Outcome out;
  const std::size_t tool = command.wish.tool < session.scene().tools.size() ? command.wish.tool : 0;
  out.before = session.tool(tool).handover.decided();
  out.result = still_his(session, command) ? obey(session, now, command) : Result::kGone;
  out.state = session.state();
  out.shed = session.relief().rung;
  out.lane = session.stop_lane();
  out.stopped_ago = out.lane.newest().level == StopLane::Level::kNone ? 0 : seconds(now - out.lane.newest().at);
  out.there = session.there(now);
  out.gathering = session.gathering();
  out.stops = session.stops();
  out.authority_version = session.authority_version();
  out.tick = session.session_tick();
  out.time = session.time();
  out.masters = static_cast<std::uint8_t>(session.scene().masters());
  out.tools = static_cast<std::uint8_t>(session.scene().tools.size());
  for (std::size_t j = 0; j < out.tools; ++j) out.alpha[j] = session.tool(j).handover.decided();
  for (std::size_t i = 0; i < session.scene().seats.size(); ++i) out.seats[i] = {session.seat(i).taken(), session.seat(i).alive(now)};
  return out;
}

}  // namespace tandem::server
