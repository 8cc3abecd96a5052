#include "server/session/session_command.h"

#include "server/session/session.h"

namespace tandem::server {
namespace {

using Result = CommandOutcome::Result;

/// A command for a seat is valid only while the connection still owns that seat.
bool holds_seat(const Session& session, const SessionCommand& command) noexcept {
  if (command.seat == AuditEvent::kNoSeat) return true;
  if (command.seat >= session.scene().seats.size() || session.participants().removing(command.seat)) return false;
  const transport::SecureChannel* const link = session.seat(command.seat).link();
  return link != nullptr && link->own_cid() == command.cid;
}

Requester requester(const SessionCommand& command) noexcept { return {command.role, command.seat}; }

Result stop(Session& session, Time now, const SessionCommand& command, StopLatch::Level wanted) noexcept {
  return session.stop_control().request(now, requester(command), wanted) ? Result::kDone : Result::kForbidden;
}

Result resume(Session& session, Time now, const SessionCommand& command) noexcept {
  if (!session.stop_latch().latched() && !session.start_condition().recovering()) return Result::kNothingToDo;
  switch (session.stop_control().resume(now, requester(command), command.number)) {
    case StopLatch::Resume::kEnded:
      return Result::kDone;
    case StopLatch::Resume::kHeldByOthers:
      return Result::kHeldByOthers;
    case StopLatch::Resume::kForbidden:
      return Result::kForbidden;
    case StopLatch::Resume::kOutdated:
      break;
  }
  return Result::kOutdated;
}

Result set_authority(Session& session, Time now, const SessionCommand& command) noexcept {
  switch (session.authority().request(now, requester(command), command.authority)) {
    case AuthorityControl::Result::kScheduled:
      return Result::kDone;
    case AuthorityControl::Result::kOutdated:
      return Result::kOutdated;
    case AuthorityControl::Result::kForbidden:
      return Result::kForbidden;
    case AuthorityControl::Result::kStaleLink:
      return Result::kStaleLink;
    case AuthorityControl::Result::kInvalid:
      break;
  }
  return Result::kInvalid;
}

Result remove(Session& session, const SessionCommand& command) noexcept {
  if (command.target_seat >= session.scene().seats.size()) return Result::kInvalid;
  const transport::SecureChannel* const link = session.seat(command.target_seat).link();
  if (link == nullptr || (command.target_cid != 0 && link->own_cid() != command.target_cid))
    return Result::kNothingToDo;
  return session.participants().remove(command.target_seat, command.close_reason) ? Result::kDone
                                                                                  : Result::kNothingToDo;
}

Result dispatch(Session& session, Time now, const SessionCommand& command) noexcept {
  switch (command.what) {
    case SessionCommand::What::kQueryStatus:
      return Result::kDone;
    case SessionCommand::What::kStop:
      return stop(session, now, command, StopLatch::Level::kStopped);
    case SessionCommand::What::kPause:
      return stop(session, now, command, StopLatch::Level::kPaused);
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
  out.connected_seats = session.participants().connected(now);
  out.recovering = session.start_condition().recovering();
  out.stops = out.stop_latch.stops();
  out.authority_version = session.authority().version();
  out.tick = session.clock().session_tick();
  out.time = session.clock().time();
  out.masters = static_cast<std::uint8_t>(session.scene().masters());
  out.tools = static_cast<std::uint8_t>(session.scene().tools.size());
  for (std::size_t j = 0; j < out.tools; ++j) out.alpha[j] = session.tool(j).transfer.scheduled();
  for (std::size_t i = 0; i < session.scene().seats.size(); ++i)
    out.seats[i] = {session.seat(i).taken(), session.seat(i).alive(now)};
  return out;
}

}  // namespace tandem::server
