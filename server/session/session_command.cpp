#include "server/session/session_command.h"

#include "server/session/session.h"

namespace tandem::server {
namespace {

using Result = CommandOutcome::Result;

/// A command for a seat is valid only while the connection still owns that seat.
bool holds_seat(const Session& session, const SessionCommand& command) noexcept {
  if (command.seat == AuditEvent::kNoSeat) return true;
  if (command.seat >= session.scene().seats.size() || session.closing_out(command.seat)) return false;
  const transport::SecureChannel* const link = session.seat(command.seat).link();
  return link != nullptr && link->own_cid() == command.cid;
}

Result resume(Session& session, Time now, const SessionCommand& command) noexcept {
  const bool stopped = session.stop_level() != StopLatch::Level::kNone;
  if (!stopped && !session.recovering()) return Result::kNothingToDo;
  if (command.number != session.stops()) return Result::kOutdated;
  if (!session.resume(now, command.role, command.number, command.seat)) return Result::kForbidden;
  return session.stop_latch().latched() && command.number == session.stops() ? Result::kHeldByOthers : Result::kDone;
}

Result set_authority(Session& session, Time now, const SessionCommand& command) noexcept {
  if (command.authority.tool >= session.scene().tools.size() || command.authority.masters != session.scene().masters())
    return Result::kInvalid;
  switch (session.set_authority(now, command.role, command.seat, AuditEvent::kControlPlane, command.authority)) {
    case Session::AuthorityResult::kScheduled:
      return Result::kDone;
    case Session::AuthorityResult::kOutdated:
      return Result::kOutdated;
    case Session::AuthorityResult::kForbidden:
      return Result::kForbidden;
    case Session::AuthorityResult::kStaleLink:
      return Result::kStaleLink;
    case Session::AuthorityResult::kInvalid:
      break;
  }
  return Result::kInvalid;
}

Result remove(Session& session, const SessionCommand& command) noexcept {
  if (command.target_seat >= session.scene().seats.size()) return Result::kInvalid;
  const transport::SecureChannel* const link = session.seat(command.target_seat).link();
  if (link == nullptr || (command.target_cid != 0 && link->own_cid() != command.target_cid))
    return Result::kNothingToDo;
  return session.remove_seat(command.target_seat, command.close_reason) ? Result::kDone : Result::kNothingToDo;
}

Result dispatch(Session& session, Time now, const SessionCommand& command) noexcept {
  switch (command.what) {
    case SessionCommand::What::kQueryStatus:
      return Result::kDone;
    case SessionCommand::What::kStop:
      return session.stop(now, command.role, command.seat) ? Result::kDone : Result::kForbidden;
    case SessionCommand::What::kPause:
      return session.pause(now, command.role, command.seat) ? Result::kDone : Result::kForbidden;
    case SessionCommand::What::kResume:
      return resume(session, now, command);
    case SessionCommand::What::kSetAuthority:
      return set_authority(session, now, command);
    case SessionCommand::What::kRemove:
      return remove(session, command);
  }
  return Result::kInvalid;
}

}  // namespace

CommandOutcome execute_command(Session& session, Time now, const SessionCommand& command) noexcept {
  CommandOutcome out;
  const std::size_t tool = command.authority.tool < session.scene().tools.size() ? command.authority.tool : 0;
  out.before = session.tool(tool).transfer.scheduled();
  out.result = holds_seat(session, command) ? dispatch(session, now, command) : Result::kSeatLost;
  out.state = session.state();
  out.shed_level = session.load_state().level;
  out.stop_latch = session.stop_latch();
  out.stop_age =
      out.stop_latch.latest().level == StopLatch::Level::kNone ? 0 : seconds(now - out.stop_latch.latest().at);
  out.connected_seats = session.connected_seats(now);
  out.recovering = session.recovering();
  out.stops = session.stops();
  out.authority_version = session.authority_version();
  out.tick = session.session_tick();
  out.time = session.time();
  out.masters = static_cast<std::uint8_t>(session.scene().masters());
  out.tools = static_cast<std::uint8_t>(session.scene().tools.size());
  for (std::size_t j = 0; j < out.tools; ++j) out.alpha[j] = session.tool(j).transfer.scheduled();
  for (std::size_t i = 0; i < session.scene().seats.size(); ++i)
    out.seats[i] = {session.seat(i).taken(), session.seat(i).alive(now)};
  return out;
}

}  // namespace tandem::server
