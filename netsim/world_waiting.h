#pragma once

#include <cstddef>
#include <string>

#include "client/seat.h"
#include "common/base/time.h"
#include "proto/scene_spec.h"
#include "server/session.h"

namespace tandem::netsim {

/// Why a seat of a session that does not begin is not engaged, for a person: the key that forbids it, its value, what was measured, and
/// the next step.
/// @param core  null: the seat was never given  @param own  the client's time  @param now  the server's
[[nodiscard]] std::string why_not_engaged(const SceneSpec& scene, std::size_t seat, const client::Seat* core, const server::Session& session,
                                          Time own, Time now);

}  // namespace tandem::netsim
