#pragma once

#include <cstdint>
#include <string_view>

#include "server/app/control_plane.h"
#include "server/app/house.h"
#include "server/app/metrics_server.h"

namespace tandem::server {

/// How the audit log is doing.
struct AuditState {
  std::string_view trouble{};        ///< why it cannot be written; empty: it can
  std::uint64_t lost = 0;            ///< lines that could not be written
  std::uint64_t left_out = 0;        ///< lines about refused peers that were too many
};

/// What those who look on are shown: `/metrics` (Prometheus text), `/healthz` (every shard turned less than a second ago) and `/readyz`
/// (that, newcomers are let in, and the audit log can be written). Plain counters are copied when somebody asks. On the control plane's thread.
[[nodiscard]] Page monitoring_page(std::string_view path, const House& house, const ControlPlane& plane, const AuditState& audit = {});

}  // namespace tandem::server
