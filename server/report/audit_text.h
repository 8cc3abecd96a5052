#pragma once

#include <string>

#include "proto/spec/scene_spec.h"
#include "server/report/audit_event.h"

namespace tandem::server {

/// Details of an event for the audit log, besides its name and session: origin, version and tick. For authority also
/// the tool, each seat's authority before and after, and the seat with a stale link.
[[nodiscard]] std::string audit_text(const AuditEvent& event, const SceneSpec& scene);

}  // namespace tandem::server
