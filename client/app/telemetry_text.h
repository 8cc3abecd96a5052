#pragma once

#include <optional>
#include <string>

#include "client/diagnostics/session_watch.h"
#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"

namespace tandem::client {

/// Returns what a watcher sees as one line: time, state, then each seat and each tool. Empty before the first
/// TELEMETRY.
/// @param recording  of the newest status; nullopt: none, or no status
[[nodiscard]] std::string telemetry_text(const SceneSpec& scene, const SessionWatch& watch,
                                         const std::optional<rpc::StatusRecording>& recording);

/// Returns the same as one line of JSON: `{"tick", "t_s", "state", "shed", "authority_version", "stops", "seats":
/// [{"name", "taken", "heard", "engaged", "stopped", "gate", "x_m", "f_n", "rtt_ms", "loss_up_percent", "gap_up_ms",
/// "loss_down_percent", "gap_down_ms", "age_p99_ms", "margin_j", "trips", "late_ticks"}], "tools": [{"name",
/// "touching", "braked", "x_m", "f_n", "depth_m", "wanted": {SEAT: AUTHORITY}, "applied": {SEAT: AUTHORITY},
/// "transfer": null or {"by", "ticks"}}], "recording": null or as `recording_json`}`. Values that are not known are
/// null.
[[nodiscard]] std::string telemetry_json(const SceneSpec& scene, const SessionWatch& watch,
                                         const std::optional<rpc::StatusRecording>& recording);

}  // namespace tandem::client
