#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "proto/access_role.h"
#include "proto/control_messages.h"
#include "proto/wire.h"

namespace tandem::server {

/// What somebody may want of a session (design notes, security 1.5; one row of its table each).
enum class Right : std::uint8_t {
  kDrive,          ///< weight over a tool; kPart: when it is given
  kForce,          ///< a hand that is engaged; kPart: with a lower clamp and tank
  kTelemetry,      ///< kPart: own and shared; at most 60 Hz; counters
  kAuthority,      ///< set weights; kPart: offer back what is his own
  kLowerLimits,    ///< kPart: his own
  kRaiseLimits,    ///< nobody: the configuration file, read at the start
  kStopOwnHand,
  kStopSession,    ///< and resume it, whoever stopped it; kPart: pause it
  kEndPause,       ///< kPart: in a scene without an instructor's seat, his own, and only a pause: see StopLane
  kRecord,         ///< start, stop, export; kPart: write
  kManageSeats,    ///< create seats and tickets, remove a person
  kManageServer,   ///< enrol and revoke workstations, drain
};
inline constexpr std::size_t kRights = 12;

enum class Grant : std::uint8_t { kNo, kPart, kYes };

/// The one place that decides who may do what.
[[nodiscard]] Grant allowed(AccessRole role, Right right) noexcept;

/// Whether a client of this role may send such a datagram at all: asked before its payload is parsed.
[[nodiscard]] bool allowed(AccessRole role, wire::Type from_client) noexcept;

/// Whether a client says such a thing at all; the rest goes the other way.
[[nodiscard]] bool said_by_clients(control::Kind kind) noexcept;
/// Whether somebody may send such a frame over his control connection: asked before its payload is parsed.
/// @param standing  the role he was welcomed in; nothing: he has not joined yet
[[nodiscard]] bool allowed(std::optional<AccessRole> standing, control::Kind kind) noexcept;
/// For somebody who may not: what it is, and who may. Cause and remedy.
[[nodiscard]] std::string why_not(std::optional<AccessRole> standing, control::Kind kind);

/// Whether somebody of this role may join without a seat of the scene: who looks after sessions, not who works in them.
[[nodiscard]] bool may_stand(AccessRole role) noexcept;

}  // namespace tandem::server
