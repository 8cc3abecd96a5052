#pragma once

#include <span>

#include "netsim/decision_log.h"
#include "netsim/demo/run_numbers.h"

namespace tandem::netsim::demo {

/// Delay and losses of the first flow over session time, thinned for a drawing.
/// @param begin  when the session began, on the clock of the decisions
/// @param length of the session [s]; what entered the network outside of it is left out
[[nodiscard]] NetworkSeries network_series(std::span<const Decision> decisions, Time begin, double length);

/// When a session of this length began that ended with the last datagram to the server: the live network does not know
/// the session's clock. Right to about 0.1 s.
[[nodiscard]] Time begin_of_session(std::span<const Decision> decisions, double length);

}  // namespace tandem::netsim::demo
