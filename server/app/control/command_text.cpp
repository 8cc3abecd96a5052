#include "server/app/control/command_text.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "server/policy/roles.h"
#include "server/session/stop_text.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;
using Result = CommandOutcome::Result;

/// Words for one kind of command.
struct Words {
  const char *audit, *done;  ///< audit word; past participle for messages, empty: no message
};

struct WordsOf {
  Words operator()(const rpc::StopSession&) const noexcept { return {"stop", "STOPPED"}; }
  Words operator()(const rpc::PauseSession&) const noexcept { return {"pause", "PAUSED"}; }
  Words operator()(const rpc::ResumeSession&) const noexcept { return {"resume", "RESUMED"}; }
  Words operator()(const rpc::SetAuthority&) const noexcept { return {"authority", ""}; }
  Words operator()(const rpc::RemoveParticipant&) const noexcept { return {"remove", "REMOVED"}; }
  Words operator()(const rpc::Note&) const noexcept { return {"note", ""}; }
  template <class Other>
  Words operator()(const Other&) const noexcept {
    return {"look", ""};
  }
};

ErrorReply error_reply(const rpc::Body& command, AccessRole role, const CommandOutcome& outcome,
                       const SeatCatalogue& seats) {
  const auto may_end = [&] { return may_end_text(outcome.stop_latch, seats.scene(), outcome.connected_seats); };
  const auto* const remove = std::get_if<rpc::RemoveParticipant>(&command);
  switch (outcome.result) {
    case Result::kForbidden:
      if (std::holds_alternative<rpc::SetAuthority>(command))
        return {ErrorCode::kNotAllowed,
                allowed(role, Right::kAuthority) == Grant::kYes
                    ? "evaluators and observers get no authority"
                    : "you may only give your own authority back to an instructor",
                0};
      if (std::holds_alternative<rpc::ResumeSession>(command) && outcome.stop_latch.latched())
        return {ErrorCode::kNotAllowed, "you may not end this stop; it can be ended by: " + may_end(), 0};
      return {ErrorCode::kNotAllowed, "your role may not do this", 0};
    case Result::kSeatLost:
      return {ErrorCode::kNotAllowed, "this connection no longer holds its seat", 0};
    case Result::kOutdated: {
      const auto* const resume = std::get_if<rpc::ResumeSession>(&command);
      const std::uint32_t stop = resume == nullptr ? 0 : resume->stop;
      if (stop > outcome.stops)
        return {ErrorCode::kOutdated, format("there is no stop %u; the newest is stop %u", stop, outcome.stops), 0};
      return {ErrorCode::kOutdated,
              format("stop %u is not the newest: stop %u followed; check its reason, then resume that stop", stop,
                     outcome.stops),
              0};
    }
    case Result::kHeldByOthers:
      return {ErrorCode::kNotAllowed, "your pause is withdrawn; still paused: " + may_end() + " can end it", 0};
    case Result::kNothingToDo:
      if (remove != nullptr) return {ErrorCode::kNoSeat, "no client is on seat " + remove->seat, 0};
      return {ErrorCode::kOutdated, "nothing is stopped: there is nothing to resume", 0};
    case Result::kNoSuchSeat:
      return {ErrorCode::kNoSeat, "no seat of this name; seats: " + seats.seat_names(), 0};
    case Result::kInvalid:
      return {ErrorCode::kBadFrame,
              format("this session has %u tools and %u masters; each master needs an authority; they must sum to 1",
                     outcome.tools, outcome.masters),
              0};
    case Result::kStaleLink:
      return {ErrorCode::kNotNow,
              "a seat whose authority would change is not connected, or its link is stale; the audit log names the "
              "seat. Check the status, then repeat the command",
              0};
    case Result::kDone:
      break;
  }
  return {ErrorCode::kInternal, "internal error: the server has no result of this command", 0};
}

}  // namespace

std::string why_in(const rpc::Body& command) {
  return std::visit(
      [](const auto& message) -> std::string {
        if constexpr (requires { message.why; }) return message.why;
        return {};
      },
      command);
}

const char* audit_word(const rpc::Body& command) noexcept { return std::visit(WordsOf{}, command).audit; }

bool is_forbidden(const CommandOutcome& outcome) noexcept {
  return outcome.result == Result::kForbidden || outcome.result == Result::kSeatLost;
}

std::string audit_detail(const std::string& who, const SessionCommand& command, const CommandOutcome& outcome,
                         const SceneSpec& scene) {
  std::string text = who;
  const auto* const authority = std::get_if<rpc::SetAuthority>(&command.body);
  if (const auto* const remove = std::get_if<rpc::RemoveParticipant>(&command.body)) {
    text += " " + remove->seat;
  } else if (const auto* const note = std::get_if<rpc::Note>(&command.body)) {
    text += format(" %s, %zu bytes", rpc::to_text(note->kind), note->json.size());
  } else if (authority != nullptr) {
    text +=
        format(" %s version %u", authority->tool < scene.tools.size() ? scene.tools[authority->tool].name.c_str() : "?",
               outcome.authority_version);
  } else {
    text += format(" stop %u", outcome.stops);
  }
  text += format(" tick %u", outcome.tick);
  for (std::size_t i = 0; authority != nullptr && !is_forbidden(outcome) && i < outcome.masters; ++i)
    text += format("%s %s %.3f to %.3f", i == 0 ? ":" : ",", scene.seats[i].name.c_str(), outcome.before[i],
                   outcome.alpha[authority->tool][i]);
  if (is_forbidden(outcome)) text += std::string(": may not ") + audit_word(command.body);
  const std::string why = why_in(command.body);
  return why.empty() ? text : text + ": " + why;
}

std::string operator_message(const std::string& who, const rpc::Body& command) {
  std::string text = std::visit(WordsOf{}, command).done;
  if (text.empty()) return {};
  if (const auto* const remove = std::get_if<rpc::RemoveParticipant>(&command)) text = remove->seat + " " + text;
  const std::string why = why_in(command);
  return text + " by " + who + (why.empty() ? "" : ": " + sanitize(why));
}

std::string not_stored_text(const rpc::Body& command, const std::string& why) {
  return truncate_utf8(
      std::string("the session is ") + std::visit(WordsOf{}, command).done + ", but this is not stored yet: " + why +
          ". If the server is killed before that, it restores the session " +
          (std::holds_alternative<rpc::ResumeSession>(command) ? "as it was before, stopped"
                                                               : "as it was before, and its hands may engage again"),
      rpc::kTextMax);
}

rpc::Body command_reply(const rpc::Body& command, AccessRole role, const CommandOutcome& outcome,
                        const SeatCatalogue& seats) {
  const bool done = outcome.result == Result::kDone;
  if (const auto* const authority = std::get_if<rpc::SetAuthority>(&command);
      authority != nullptr && (done || outcome.result == Result::kOutdated)) {
    const auto& alpha = outcome.alpha[authority->tool];
    return rpc::AuthorityReply{
        done, authority->tool, outcome.authority_version, {alpha.begin(), alpha.begin() + outcome.masters}};
  }
  return done ? rpc::Body{rpc::Ok{}} : error_reply(command, role, outcome, seats);
}

}  // namespace tandem::server
