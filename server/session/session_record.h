#pragma once

#include <array>
#include <cstddef>

#include "server/session/session.h"

namespace tandem::server {

/// Fill the record of a seat or a slave from the seat's newest STATE and telemetry.
/// @param port   space of the scene's ports, in which STATE has the velocity
/// @param scale  motion of the tool per motion of the hand: records have tip and forces of the hand as the tool sees
/// them
void record_seat(const wire::StateMessage& said, const wire::Telemetry& telemetry, PortSpace port, double scale,
                 SeatRecord& record) noexcept;
void record_slave(const wire::Telemetry& said, ToolRecord& record) noexcept;

/// Fills what records and watchers show of a tool's slave. A SLAVE seat has the values of its newest telemetry; a tool
/// without a slave has its own.
/// @param x            tip, or position of the virtual mass [m]
/// @param f_env        force of the environment on it [N]
/// @param penetration  in the environment [m]
void slave_motion(const Session& session, std::size_t tool, std::array<double, 3>& x, std::array<double, 3>& f_env,
                  double& penetration) noexcept;

/// Fills the record of this tick for traces and reports. Values of seats are those of their newest STATE.
void record_tick(const Session& session, const LeadingHands& leading, TickRecord& record) noexcept;

}  // namespace tandem::server
