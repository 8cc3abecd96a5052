#include "proto/rpc/ticket_codec.h"

#include "common/base/raw_bytes.h"
#include "proto/rpc/canonical_bytes.h"
#include "proto/rpc/rpc_bounds.h"
#include "proto/schema/ticket.pb.h"

namespace tandem::rpc {
std::vector<std::byte> encode(const TicketContent& content) {
  pb::Ticket out;
  out.set_role(content.role);
  out.set_force_scale(content.force_scale);
  out.set_ticket_id(text_of(content.ticket_id));
  out.set_session_id(text_of(content.session_id));
  out.set_workstation(text_of(content.workstation));
  out.set_seat(content.seat);
  out.set_not_before(content.not_before);
  out.set_not_after(content.not_after);
  out.set_epoch_min(content.epoch_min);
  out.set_person(content.person);
  return serialized(out);
}

std::vector<std::byte> encode(const SignedTicket& ticket) {
  pb::SignedTicket out;
  out.set_version(ticket.version);
  out.set_kid(ticket.kid);
  out.set_ticket(text_of(ticket.content));
  out.set_signature(text_of(ticket.signature));
  return serialized(out);
}

std::optional<TicketContent> decode_ticket_content(std::span<const std::byte> bytes) {
  pb::Ticket in;
  TicketContent out;
  const bool good = parse(bytes, in, kSignedTicketMax) && take(in.ticket_id(), out.ticket_id) &&
                    take(in.session_id(), out.session_id) && take(in.workstation(), out.workstation);
  if (!good) return std::nullopt;
  out.role = in.role();
  out.force_scale = in.force_scale();
  out.seat = in.seat();
  out.not_before = in.not_before();
  out.not_after = in.not_after();
  out.epoch_min = in.epoch_min();
  out.person = in.person();
  return if_canonical(std::move(out), bytes);
}

std::optional<SignedTicket> decode_signed_ticket(std::span<const std::byte> bytes) {
  pb::SignedTicket in;
  SignedTicket out;
  if (!parse(bytes, in, kSignedTicketMax) || !take(in.signature(), out.signature)) return std::nullopt;
  out.version = in.version();
  out.kid = in.kid();
  const auto content = bytes_of(in.ticket());
  out.content.assign(content.begin(), content.end());
  return if_canonical(std::move(out), bytes);
}

}  // namespace tandem::rpc
