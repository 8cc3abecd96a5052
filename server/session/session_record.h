#pragma once

#include "server/session/session.h"

namespace tandem::server {

/// Fill the record of a seat or a slave from the seat's newest STATE and telemetry.
/// @param port   space of the scene's ports, in which STATE has the velocity
/// @param scale  motion of the tool per motion of the hand: records have tip and forces of the hand as the tool sees
/// them
void record_seat(const wire::StateMessage& said, const wire::Telemetry& telemetry, PortSpace port, double scale,
                 SeatRecord& record) noexcept;
void record_slave(const wire::Telemetry& said, ToolRecord& record) noexcept;

/// Fills the record of this tick for traces and reports. Values of seats are those of their newest STATE.
void record_tick(const Session& session, const LeadingHands& leading, TickRecord& record) noexcept;

}  // namespace tandem::server
