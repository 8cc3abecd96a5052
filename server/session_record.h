#pragma once

#include "server/session.h"

namespace tandem::server {

/// Writes what a trace or a report wants of this tick. Seats are as the server last heard of them.
void take_record(const Session& session, TickRecord& record) noexcept;

}  // namespace tandem::server
