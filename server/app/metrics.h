#pragma once

#include <string_view>

#include "server/app/control_plane.h"
#include "server/app/house.h"
#include "server/app/metrics_server.h"

namespace tandem::server {

/// What those who look on are shown: `/metrics` (Prometheus text), `/healthz` (every shard turned less than a second ago) and `/readyz`
/// (that, and newcomers are let in). Plain counters are copied when somebody asks. On the control plane's thread.
[[nodiscard]] Page monitoring_page(std::string_view path, const House& house, const ControlPlane& plane);

}  // namespace tandem::server
