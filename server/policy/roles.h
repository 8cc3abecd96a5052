#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/access_role.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

/// Rights in a session that messages of clients need, one per row of the table in roles.cpp (ARCHITECTURE.md, invariant
/// 34).
enum class Right : std::uint8_t {
  kDrive,         ///< have authority over a tool; kPart: if it is given
  kForce,         ///< be engaged; kPart: with a lower force clamp and energy tank
  kTelemetry,     ///< kPart: own and shared; at most 60 Hz; counters
  kAuthority,     ///< set authority; kPart: give back the seat's own
  kStopSession,   ///< also resume it, whatever the origin of the stop; kPart: pause it
  kEndPause,      ///< kPart: the seat's own pauses only, in a scene without an instructor seat (StopLatch)
  kManageSeats,   ///< create seats and tickets, remove a participant
  kManageServer,  ///< enrol and revoke workstations, create and end sessions, drain
  kScore,         ///< write marks and sheets of an assessment
  kRecord,        ///< start and end the server's recording of a session
};
inline constexpr std::size_t kRights = 10;

enum class Grant : std::uint8_t { kNo, kPart, kYes };

/// Grant of a right to a role. The only table of permissions; kNo for unknown values.
[[nodiscard]] Grant allowed(AccessRole role, Right right) noexcept;

/// Whether a client of this role may send datagrams of this type. Checked before the payload is parsed.
[[nodiscard]] bool allowed(AccessRole role, wire::Type from_client) noexcept;

/// Whether clients send frames of this kind; the other kinds are sent by the server.
[[nodiscard]] bool is_client_message(rpc::Kind kind) noexcept;
/// Whether a client may send this frame on its control connection. Checked before the payload is parsed.
/// @param standing  role granted in Welcome; nothing: not joined yet
[[nodiscard]] bool allowed(std::optional<AccessRole> standing, rpc::Kind kind) noexcept;
/// Error text for a forbidden frame: the rejected action and the roles that may perform it.
[[nodiscard]] std::string forbidden_text(std::optional<AccessRole> standing, rpc::Kind kind);

/// Whether this role may join as a console, without a seat of the scene: roles that operate sessions.
[[nodiscard]] bool may_join_console(AccessRole role) noexcept;

}  // namespace tandem::server
