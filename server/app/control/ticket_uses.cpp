#include "server/app/control/ticket_uses.h"

#include <algorithm>
#include <utility>

#include "common/auth/io/state_directory.h"
#include "proto/rpc/ticket_codec.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;

ErrorReply not_used_reply(TicketUses::Outcome outcome) {
  if (outcome == TicketUses::Outcome::kUsed)
    return {ErrorCode::kTicket,
            "this ticket was used before, at a server of the service; ask an operator for another one", 0};
  return {ErrorCode::kNotNow,
          "this server cannot know whether the ticket was used: the directory of the service does not answer, or "
          "another server has the session; the ticket stays valid, try again",
          2};
}

}  // namespace

std::function<void(JoinReply)> used_once(TicketUses* uses, const JoinRequest& request,
                                         std::function<void(JoinReply)> answer,
                                         std::function<void(const rpc::Welcome&)> failed,
                                         std::function<bool(const rpc::Welcome&)> again) {
  const auto* const credential = std::get_if<rpc::TicketCredential>(&request.hello.credential);
  if (uses == nullptr || credential == nullptr) return answer;
  const auto sealed = rpc::decode_signed_ticket(credential->bytes);
  const auto content = sealed ? rpc::decode_ticket_content(sealed->content) : std::nullopt;
  if (!content) return answer;  // no Welcome follows
  return [uses, ticket = content->ticket_id, not_after = content->not_after, answer = std::move(answer),
          failed = std::move(failed), again = std::move(again)](JoinReply reply) {
    const auto* const welcome = std::get_if<rpc::Welcome>(&reply);
    if (welcome == nullptr) return answer(std::move(reply));
    const std::string session = welcome->session_name;
    const std::int64_t life_s = std::max<std::int64_t>(not_after - auth::wall_seconds(), 0);
    const bool returns = again(*welcome);
    uses->use(session, ticket, life_s, returns,
              [answer, failed, reply = std::move(reply)](TicketUses::Outcome outcome) mutable {
                if (outcome == TicketUses::Outcome::kAccepted) return answer(std::move(reply));
                failed(std::get<rpc::Welcome>(reply));
                answer(not_used_reply(outcome));
              });
  };
}

}  // namespace tandem::server
