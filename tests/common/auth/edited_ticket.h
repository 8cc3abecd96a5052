#pragma once

#include <span>
#include <vector>

#include "proto/rpc/ticket_codec.h"
#include "proto/spec/access_role.h"

namespace tandem::auth::test {

/// Returns the ticket with another role and the old signature, as a forger would edit it. @pre `bytes` are a ticket
inline std::vector<std::byte> with_role(std::span<const std::byte> bytes, AccessRole role) {
  auto ticket = *rpc::decode_signed_ticket(bytes);
  auto content = *rpc::decode_ticket_content(ticket.content);
  content.role = static_cast<std::uint32_t>(role);
  ticket.content = rpc::encode(content);
  return rpc::encode(ticket);
}

}  // namespace tandem::auth::test
