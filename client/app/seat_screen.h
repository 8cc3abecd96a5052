#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/app/client_status.h"
#include "common/io/text_layout.h"
#include "proto/control_messages.h"

namespace tandem::client {

/// What the screen of a seat shows, the important first. Row 0: the state of the session and how it goes on, who leads, the own force. Row 1: where the
/// tool is and whether it touches something, who else is there, the force gate in words, then the numbers of the link.
/// @param words  what the server said last over the control connection; nothing: it was not heard there
[[nodiscard]] std::vector<io::ScreenItem> seat_screen(const ClientStatus& status, const SeatSetup& setup, const std::optional<control::Status>& words);

/// The force gate in words, and which key helps.
[[nodiscard]] std::string gate_text(const ClientStatus& status);
/// `[####......] 1.24 N`: the share of the largest force that this seat gives.
[[nodiscard]] std::string force_bar(double force_n, double force_max_n);
/// How the person at this seat gets out of a stop or a pause, `r resumes` or who does.
[[nodiscard]] std::string way_out(const SeatSetup& setup, bool paused);

}  // namespace tandem::client
