#pragma once

#include <cstddef>
#include <cstdint>

#include "proto/access_role.h"
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
  kStopSession,    ///< and resume it; kPart: pause it, which who has kYes ends
  kRecord,         ///< start, stop, export; kPart: write
  kManageSeats,    ///< create seats and tickets, remove a person
  kManageServer,   ///< enrol and revoke workstations, drain
};
inline constexpr std::size_t kRights = 11;

enum class Grant : std::uint8_t { kNo, kPart, kYes };

/// The one place that decides who may do what.
[[nodiscard]] Grant allowed(AccessRole role, Right right) noexcept;

/// Whether a client of this role may send such a datagram at all: asked before its payload is parsed.
[[nodiscard]] bool allowed(AccessRole role, wire::Type from_client) noexcept;

}  // namespace tandem::server
