#pragma once

#include <cstdint>

#include "proto/spec/access_role.h"
#include "server/report/audit_event.h"

namespace tandem::server {

/// Origin of a request to a session: the participant at a seat, by datagram or by control connection, or a console.
struct Requester {
  AccessRole role = AccessRole::kObserver;
  std::uint8_t seat = AuditEvent::kNoSeat;              ///< kNoSeat: a console
  std::uint8_t audited_as = AuditEvent::kControlPlane;  ///< `AuditEvent::seat` of the events that the request causes
};

/// Request in a datagram of a seat's client.
[[nodiscard]] constexpr Requester requester_at(std::size_t seat, AccessRole role) noexcept {
  return {role, static_cast<std::uint8_t>(seat), static_cast<std::uint8_t>(seat)};
}

}  // namespace tandem::server
