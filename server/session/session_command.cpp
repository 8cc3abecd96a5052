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
  if (command.seat >= session.scene().seats.size() || session.participants().removing(command.seat)) return false;
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
  Result operator()(const rpc::StopSession&) const noexcept { return stop(StopLatch::Level::kStopped); }
  Result operator()(const rpc::PauseSession&) const noexcept { return stop(StopLatch::Level::kPaused); }
  Result operator()(const rpc::ResumeSession& resume) const noexcept {
    if (!session.stop_latch().latched() && !session.start_condition().recovering()) return Result::kNothingToDo;
    switch (session.stop_control().resume(now, requester(), resume.stop)) {
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
  Result operator()(const rpc::SetAuthority& wanted) const noexcept {
    if (wanted.tool >= session.scene().tools.size() || wanted.alpha.size() != session.scene().masters())
      return Result::kInvalid;
    out.before = session.tool(wanted.tool).transfer.scheduled();
    wire::AuthorityMessage message;
    message.tool = wanted.tool;
    message.version = wanted.version;
    message.masters = static_cast<std::uint32_t>(wanted.alpha.size());
    std::ranges::copy(wanted.alpha, message.alpha.begin());
    switch (session.authority().request(now, requester(), message)) {
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

 private:
  [[nodiscard]] Requester requester() const noexcept { return {command.role, command.seat}; }
  [[nodiscard]] Result stop(StopLatch::Level wanted) const noexcept {
    return session.stop_control().request(now, requester(), wanted) ? Result::kDone : Result::kForbidden;
  }
};

}  // namespace

Result remove_client(Session& session, std::size_t seat, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (seat >= session.scene().seats.size()) return Result::kNoSuchSeat;
  const transport::SecureChannel* const link = session.seat(seat).link();
  if (link == nullptr || (cid != 0 && link->own_cid() != cid)) return Result::kNothingToDo;
  return session.participants().remove(seat, why) ? Result::kDone : Result::kNothingToDo;
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
