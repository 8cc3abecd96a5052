#pragma once

#include <string>

#include "client/diagnostics/session_watch.h"
#include "proto/spec/scene_spec.h"

namespace tandem::client {

/// Returns what a watcher sees as JSON for PlotJuggler, which makes a curve of every number in nested objects, such as
/// `seats/trainer/measured_cp/x`. Values that are not known are left out. SI units; other units are in the name.
/// @param timestamp_s  time of the sample, field `timestamp` [s]
/// @return `{"timestamp", "session": {"t", "tick", "running", "stops", "shed_level"}, "seats": {NAME: {"taken",
/// "heard", "engaged", "stopped", "gate", "measured_cp": {"x", "y", "z"}, "measured_cf": {"x", "y", "z", "norm"},
/// "rtt_ms", "loss_up_percent", "loss_down_percent", "gap_up_ms", "gap_down_ms", "age_p99_ms", "margin_j",
/// "gate_trips", "late_ticks"}}, "tools": {NAME: {"touching", "braked", "measured_cp", "environment_cf",
/// "penetration", "alpha": {SEAT: AUTHORITY}}}}`; empty before the first TELEMETRY
[[nodiscard]] std::string plot_json(const SceneSpec& scene, const SessionWatch& watch, double timestamp_s);

}  // namespace tandem::client
