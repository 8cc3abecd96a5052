#pragma once

#include "proto/wire/session_telemetry.h"
#include "server/session/session.h"

namespace tandem::server {

/// Link and device of a seat, now. Values that are not known, also those of a seat without a participant, are NaN.
[[nodiscard]] wire::WatchedLink link_of(const Session& session, Time now, std::size_t seat) noexcept;

/// Fills the TELEMETRY of this tick from the session and its record.
/// @param turn  number of the datagram: selects the seat of `link` and the tool of `authority`
/// @pre session.record() is of this tick
void fill_telemetry(const Session& session, Time now, std::uint32_t turn, wire::SessionTelemetry& out) noexcept;

}  // namespace tandem::server
