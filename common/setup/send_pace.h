#pragma once

#include "common/control/channel.h"
#include "common/control/send_pace.h"
#include "proto/text/seat_setup.h"

/// When the datagrams of a master are sent. Client and server use this same code, so that each end knows what the other
/// one predicts.
namespace tandem::setup {

/// Returns how one end paces its datagrams, in the units of the tool. @pre setup.send.is_on()
[[nodiscard]] control::SendPace::Params send_pace(const SeatSetup& setup, control::Side sender) noexcept;

/// Returns the prediction of what the other end holds back; it is off for a seat without `send`.
[[nodiscard]] control::HeldSample held_sample(const SeatSetup& setup) noexcept;

}  // namespace tandem::setup
