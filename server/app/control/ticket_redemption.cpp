#include "server/app/control/ticket_redemption.h"

#include <utility>

#include "common/io/log.h"
#include "proto/rpc/ticket_codec.h"
#include "server/app/control/audit_writer.h"

namespace tandem::server {
namespace {

auth::TicketUse use_of(const SessionEntry& entry, const JoinRequest& request, std::optional<AccessRole> role) {
  return {entry.registration.id,
          entry.registration.epoch,
          request.hello.seat,
          role,
          auth::KeyFingerprint{request.workstation.spki},
          auth::wall_seconds(),
          request.workstation.enrolled_at};
}

}  // namespace

std::optional<auth::Id16> claimed_id(const rpc::TicketCredential& ticket) {
  const auto sealed = rpc::decode_signed_ticket(ticket.bytes);
  const auto content = sealed ? rpc::decode_ticket_content(sealed->content) : std::nullopt;
  return content ? std::optional(content->ticket_id) : std::nullopt;
}

std::expected<auth::Ticket, rpc::ErrorReply> TicketRedemption::redeem(const SessionEntry& entry,
                                                                      const JoinRequest& request,
                                                                      const rpc::TicketCredential& ticket,
                                                                      std::optional<AccessRole> role, Time now) {
  const auto attempt = [&] { return trust_.tickets().redeem(ticket.bytes, use_of(entry, request, role)); };
  auto redeemed = attempt();
  // This server has seen the ticket before, as an earlier owner of the session. All other rules hold for it.
  if (!redeemed && redeemed.error().fault && redeemed.error().fault->rule == auth::TicketCheck::kUsed)
    if (const auto id = claimed_id(ticket); id && entry.consoles.returns(*id, now)) {
      static_cast<void>(trust_.tickets().restore(*id));  // on an error the next line is written again by `attempt`
      redeemed = attempt();
    }
  if (redeemed) return std::move(*redeemed);
  if (!redeemed.error().fault) {  // a failure of the server itself
    if (on_message_) on_message_("no ticket can be used: " + redeemed.error().text);
    io::log_event(io::Level::kError, {.event = "error", .text = redeemed.error().text});
  }
  return std::unexpected(ticket_error_reply(redeemed.error()));
}

std::optional<rpc::ErrorReply> TicketRedemption::used(const SessionEntry& entry, const JoinRequest& request,
                                                      const rpc::TicketCredential& ticket, AccessRole role) const {
  if (!trust_.tickets().was_redeemed(ticket.bytes, use_of(entry, request, role))) return std::nullopt;
  const auth::TicketError fault{auth::TicketCheck::kUsed, 0, {}};
  return ticket_error_reply({fault, auth::to_text(fault)});
}

void TicketRedemption::restore(const std::optional<auth::Id16>& ticket, const std::string& session,
                               const std::string& person, const char* event) {
  if (!ticket) return;
  const std::string problem = trust_.tickets().restore(*ticket);
  if (uses_ != nullptr) uses_->restore(session, *ticket);
  trust_.audit(auth::wall_seconds(), event, session,
               auth::to_hex(*ticket) + (problem.empty() ? "" : ": " + problem) + by_person(person));
}

}  // namespace tandem::server
