#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/app/client_status.h"
#include "common/io/text_layout.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Returns the items of the seat screen, the most important first. Row 0: session state and the way out of it, leader,
/// own force. Row 1: tool position and contact, other participants, force gate, numbers of the link.
/// @param words  newest status over the control connection; empty: none received
[[nodiscard]] std::vector<io::ScreenItem> seat_screen(const ClientStatus& status, const SeatSetup& setup,
                                                      const std::optional<rpc::Status>& words);

/// Returns the gate state as text, with the key that changes it.
[[nodiscard]] std::string gate_text(const ClientStatus& status);
/// Returns the force as a bar and a number, e.g. `[####......] 1.2 N`. A full bar is `force_max_n`.
[[nodiscard]] std::string force_bar(double force_n, double force_max_n);
/// Returns how a stop or pause ends as seen from this seat, e.g. `r resumes` or `an operator resumes`.
[[nodiscard]] std::string way_out(const SeatSetup& setup, bool paused);

}  // namespace tandem::client
