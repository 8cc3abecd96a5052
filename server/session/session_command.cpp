#include "server/session/session_command.h"

#include <algorithm>
#include <string_view>
#include <variant>

#include "server/policy/roles.h"
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

/// Seat and authority that a command refers to, for its outcome.
struct Effect {
  std::uint8_t target_seat = 0;
  control::MasterArray before{};
};

/// Executes a command by its message.
struct Execution {
  Session& session;
  Time now;
  const SessionCommand& command;
  Effect& effect;

  Result operator()(const rpc::StatusRequest&) const noexcept { return Result::kDone; }
  Result operator()(const rpc::StopSession& halt) const noexcept { return stop(StopLatch::Level::kStopped, halt.why); }
  Result operator()(const rpc::PauseSession& pause) const noexcept {
    return stop(StopLatch::Level::kPaused, pause.why);
  }
  Result operator()(const rpc::ResumeSession& resume) const noexcept {
    if (!session.stop_control().latch().latched() && !session.start_condition().recovering())
      return Result::kNothingToDo;
    return session.stop_control().resume(now, requester(), resume.stop);
  }
  Result operator()(const rpc::SetAuthority& wanted) const noexcept {
    if (wanted.tool >= session.scene().tools.size() || wanted.alpha.size() != session.scene().masters())
      return Result::kInvalid;
    effect.before = session.tool(wanted.tool).transfer.scheduled();
    wire::AuthorityMessage message;
    message.tool = wanted.tool;
    message.version = wanted.version;
    message.masters = static_cast<std::uint32_t>(wanted.alpha.size());
    std::ranges::copy(wanted.alpha, message.alpha.begin());
    return session.authority().request(now, requester(), message);
  }
  Result operator()(const rpc::RemoveParticipant& remove) const noexcept {
    const auto seat = session.seat_catalogue().seat_named(remove.seat);
    if (!seat) return Result::kNoSuchSeat;
    effect.target_seat = static_cast<std::uint8_t>(*seat);
    return remove_client(session, *seat, 0, wire::CloseReason::kRemoved);
  }
  /// A note changes nothing in the session, which adds its tick and time.
  Result operator()(const rpc::Note&) const noexcept {
    return allowed(command.role, Right::kScore) == Grant::kYes ? Result::kDone : Result::kForbidden;
  }
  template <class Other>
  Result operator()(const Other&) const noexcept {
    return Result::kInvalid;
  }

 private:
  [[nodiscard]] Requester requester() const noexcept { return {command.role, command.seat}; }
  [[nodiscard]] Result stop(StopLatch::Level wanted, std::string_view why) const noexcept {
    const StopLatch::Words words{FixedText<rpc::kNameMax>{command.workstation},
                                 FixedText<rpc::kNameMax>{command.person}, FixedText<rpc::kTextMax>{why}};
    return session.stop_control().request(now, requester(), wanted, words) ? Result::kDone : Result::kForbidden;
  }
};

}  // namespace

Result remove_client(Session& session, std::size_t seat, std::uint32_t cid, wire::CloseReason why) noexcept {
  if (seat >= session.scene().seats.size()) return Result::kNoSuchSeat;
  const transport::SecureChannel* const link = session.seat(seat).link();
  if (link == nullptr || (cid != 0 && link->own_cid() != cid)) return Result::kNothingToDo;
  return session.remove(seat, why) ? Result::kDone : Result::kNothingToDo;
}

CommandOutcome execute_command(Session& session, Time now, const SessionCommand& command) noexcept {
  if (InputJournal* const journal = session.journal()) journal->command(now, command);
  Effect effect;
  session.audit().set_order(command.order);
  const Result result = holds_seat(session, command)
                            ? std::visit(Execution{session, now, command, effect}, command.body)
                            : Result::kSeatLost;
  session.audit().set_order(0);
  const StopLatch& stop = session.stop_control().latch();
  const StopLatch::Latest& latest = stop.latest();
  CommandOutcome out{.result = result,
                     .state = session.state(),
                     .stop_latch = stop,
                     .stop_age = latest.level == StopLatch::Level::kNone ? 0 : seconds(now - latest.at),
                     .connected_seats = session.participants().connected(now),
                     .recovering = session.start_condition().recovering(),
                     .stops = stop.stops(),
                     .authority_version = session.authority().version(),
                     .tick = session.clock().session_tick(),
                     .orders = session.stop_control().orders(),
                     .restores = session.stop_control().restores(),
                     .time = session.clock().time(),
                     .may_act = session.lifecycle().may_act(),
                     .shed_level = session.lifecycle().load_state().level,
                     .masters = static_cast<std::uint8_t>(session.scene().masters()),
                     .tools = static_cast<std::uint8_t>(session.scene().tools.size()),
                     .target_seat = effect.target_seat,
                     .before = effect.before};
  for (std::size_t j = 0; j < out.tools; ++j) out.alpha[j] = session.tool(j).transfer.scheduled();
  for (std::size_t i = 0; i < session.scene().seats.size(); ++i)
    out.seats[i] = {session.seat(i).taken(), session.seat(i).alive(now)};
  return out;
}

}  // namespace tandem::server
