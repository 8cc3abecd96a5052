#pragma once

#include <cstdint>
#include <string_view>

#include "server/app/control/control_plane.h"
#include "server/app/control/session_registry.h"
#include "server/app/monitor/metrics_server.h"

namespace tandem::server {

/// State of the audit log.
struct AuditState {
  std::string_view trouble{};  ///< current write error; empty: none
  std::uint64_t lost = 0;      ///< lines that could not be written
  std::uint64_t left_out = 0;  ///< lines about rejected peers that the throttle suppressed
};

/// Response to `/metrics` (Prometheus text), `/healthz` and `/readyz`. `/healthz` is 200 while every shard ticked less
/// than a second ago. `/readyz` also requires that joins are accepted and the audit log can be written. Counters are
/// copied at each request. Call it on the control plane's thread.
[[nodiscard]] HttpResponse monitoring_page(std::string_view path, const SessionRegistry& registry,
                                           const ControlPlane& plane, const AuditState& audit = {});

}  // namespace tandem::server
