#pragma once

#include <span>

#include "netsim/demo/run_numbers.h"
#include "netsim/engine/decision_log.h"

namespace tandem::netsim::demo {

/// Returns delay and losses of the first flow over session time, reduced for a drawing.
/// @param begin   begin of the session, on the clock of the decisions
/// @param length  length of the session [s]; datagrams sent outside of it are left out
[[nodiscard]] NetworkSeries network_series(std::span<const Decision> decisions, Time begin, double length);

/// Returns the begin of a session of this length, which ended with the last datagram to the server. The live network
/// does not know the session's clock. The result is accurate to about 0.1 s.
[[nodiscard]] Time begin_of_session(std::span<const Decision> decisions, double length);

}  // namespace tandem::netsim::demo
