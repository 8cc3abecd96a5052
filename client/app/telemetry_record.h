#pragma once

#include "client/diagnostics/session_watch.h"
#include "proto/spec/scene_spec.h"
#include "server/report/tick_record.h"

namespace tandem::client {

/// Returns the newest TELEMETRY of a watch as the record of a tick. Its time is that of the session clock. It has
/// single precision, and no joints, no commanded forces, no energies and no ages of samples: those are NaN or 0.
/// Authority comes for one tool per datagram, so that over several tools it is up to as many ticks old.
/// @pre watch.newest() has a value
[[nodiscard]] server::TickRecord record_of(const SceneSpec& scene, const SessionWatch& watch);

}  // namespace tandem::client
