#pragma once

#include <optional>
#include <string>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"
#include "server/session/stop_latch.h"

/// Messages about a stop, for users.
namespace tandem::server {

/// Names of those that can end the stop, and their keys, such as `trainee (key r) or an operator`. Empty if nothing is
/// stopped.
/// @param there  connected seats, bit i for seat i
[[nodiscard]] std::string may_end_text(const StopLatch& latch, const SceneSpec& scene, std::uint32_t there);

/// The newest stop, as far as the session knows its author; the control plane adds the person at a seat.
/// @param ago_s  age of the stop [s]
/// @param there  connected seats, bit i for seat i
/// @return nothing if the session knows no stop and none is latched
[[nodiscard]] std::optional<tandem::rpc::StatusStop> latest_stop(const StopLatch& latch, const SceneSpec& scene,
                                                                 double ago_s, std::uint32_t there);

}  // namespace tandem::server
