#pragma once

#include <optional>
#include <string>

#include "proto/control_messages.h"
#include "proto/scene_spec.h"
#include "server/stop_lane.h"

/// What people read of a stop.
namespace tandem::server {

/// Who may end it, and how: `trainee (key r) or an operator`. Empty: nothing is stopped.
/// @param there  seats whose clients are heard, bit i: seat i
[[nodiscard]] std::string who_ends(const StopLane& lane, const SceneSpec& scene, std::uint32_t there);

/// The newest stop as far as the session knows it: from which seat, in which role; of consoles the house knows more. Nothing if nobody
/// stopped since this server began, and nothing is stopped.
[[nodiscard]] std::optional<tandem::control::StatusStop> newest_stop(const StopLane& lane, const SceneSpec& scene, double ago_s, std::uint32_t there);

}  // namespace tandem::server
