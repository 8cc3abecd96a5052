#pragma once

#include "server/session.h"

namespace tandem::server {

/// A seat's and a slave's part of a record, from what the seat said.
void put_seat(const wire::StateMessage& said, SeatRecord& record) noexcept;
void put_slave(const wire::Telemetry& said, ToolRecord& record) noexcept;

/// Writes what a trace or a report wants of this tick. Seats are as the server last heard of them.
void take_record(const Session& session, TickRecord& record) noexcept;

}  // namespace tandem::server
