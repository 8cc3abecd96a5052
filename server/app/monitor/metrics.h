#pragma once

#include <cstdint>
#include <string_view>

#include "server/app/control/audit_writer.h"
#include "server/app/control/control_plane.h"
#include "server/app/control/session_registry.h"
#include "server/app/monitor/metrics_server.h"
#include "server/service/service_member.h"

namespace tandem::server {

/// Response to `/metrics` (Prometheus text), `/healthz` and `/readyz`. `/healthz` is 200 while every shard ticked less
/// than a second ago. `/readyz` also requires that joins are accepted and the audit log can be written, and of a member
/// of a service that it is registered, its directory answers and no session is HELD. Otherwise both are 503 with the
/// reason. Counters are copied at each request. Call it on the control plane's thread.
/// @param service  of a member of a service; null: the server is alone
[[nodiscard]] HttpResponse monitoring_page(std::string_view path, const SessionRegistry& registry,
                                           const ControlPlane& plane, const AuditState& audit = {},
                                           const ServiceStatus* service = nullptr);

}  // namespace tandem::server
