#pragma once

#include "client/app/client_status.h"
#include "client/app/live_seat.h"
#include "proto/text/seat_setup.h"
#include "tandem/hal.h"

/// @file
/// A seat of a session in one's own program. CMake target `Tandem::client`.
///
/// tandem::client::LiveSeat joins a running server over the network. A device calls it once per exchange, on the
/// device's own thread. Everything that protects the hand runs there: reference clamp, guards, force gate. The program
/// reads tandem::client::ClientStatus and requests stops, resumes and the end. Example:
/// tests/examples/03_client_seat.cpp.
namespace tandem::client {

/// Reason for which the server or the client closed the seat, such as `kDone` or `kServerStops`.
using wire::CloseReason;
/// State of the force gate: `kOff`, `kZero`, `kRampIn`, `kActive`, `kReleasing`, `kLatched`, `kFault`.
using wire::GateState;
/// State of the session: `kWaiting` for seats, `kRunning`, `kHeld` (no authorised seat), `kPaused`, `kStopped`,
/// `kEnding`, `kOverloaded`.
using wire::SessionState;

}  // namespace tandem::client
