#include "server/session/session_command.h"

#include <algorithm>
#include <variant>

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

/// Executes a command by its message.
struct Execution {
  Session& session;
  Time now;
  const SessionCommand& command;
  CommandOutcome& out;

  Result operator()(const rpc::StatusRequest&) const noexcept { return Result::kDone; }
  Result operator()(const rpc::StopSession&) const noexcept {
    return session.stop(now, command.role, command.seat) ? Result::kDone : Result::kForbidden;
  }
  Result operator()(const rpc::PauseSession&) const noexcept {
    return session.pause(now, command.role, command.seat) ? Result::kDone : Result::kForbidden;
  }
  Result operator()(const rpc::ResumeSession& resume) const noexcept {
    const bool stopped = session.stop_level() != StopLatch::Level::kNone;
    if (!stopped && !session.recovering()) return Result::kNothingToDo;
    if (resume.stop != session.stops()) return Result::kOutdated;
    if (!session.resume(now, command.role, resume.stop, command.seat)) return Result::kForbidden;
    return session.stop_latch().latched() && resume.stop == session.stops() ? Result::kHeldByOthers : Result::kDone;
  }
  Result operator()(const rpc::SetAuthority& wanted) const noexcept {
    if (wanted.tool >= session.scene().tools.size() || wanted.alpha.size() != session.scene().masters())
      return Result::kInvalid;
    out.before = session.tool(wanted.tool).transfer.scheduled();
    wire::AuthorityMessage message;
    message.tool = wanted.tool;
    message.version = wanted.version;
    message.masters = static_cast<std::uint32_t>(wanted.alpha.size());
    std::ranges::copy(wanted.alpha, message.alpha.begin());
    switch (session.set_authority(now, command.role, command.seat, AuditEvent::kControlPlane, message)) {
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
  Result operator()(const rpc::RemoveParticipant& remove) const noexcept {
    const auto seat = session.seat_catalogue().seat_named(remove.seat);
    if (!seat) return Result::kNoSuchSeat;
    out.target_seat = static_cast<std::uint8_t>(*seat);
    return remove_client(session, *seat, 0, wire::CloseReason::kRemoved);
  }
  template <class Other>
  Result operator()(const Other&) const noexcept {
    return Result::kInvalid;
  }
};

}  // namespace

Result remove_client(Session& session, std::size_t seat, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (seat >= session.scene().seats.size()) return Result::kNoSuchSeat;
  const transport::SecureChannel* const link = session.seat(seat).link();
  if (link == nullptr || (cid != 0 && link->own_cid() != cid)) return Result::kNothingToDo;
  return session.remove_seat(seat, why) ? Result::kDone : Result::kNothingToDo;
}

CommandOutcome execute_command(Session& session, Time now, const SessionCommand& command) noexcept {
  CommandOutcome out;
  out.result = holds_seat(session, command) ? std::visit(Execution{session, now, command, out}, command.body)
                                            : Result::kSeatLost;
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
