#pragma once

#include <cstddef>
#include <string>

#include "client/seat/seat.h"
#include "common/base/time.h"
#include "proto/spec/scene_spec.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Returns why a seat is not engaged in a session that does not begin. The text names the key that forbids it, its
/// value, the measured value and the next step.
/// @param core  null: the client never had the seat
/// @param own   time on the client's clock
/// @param now   time on the server's clock
[[nodiscard]] std::string not_engaged_reason(const SceneSpec& scene, std::size_t seat, const client::Seat* core,
                                             const server::Session& session, Time own, Time now);

}  // namespace tandem::netsim
