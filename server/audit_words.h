#pragma once

#include <string>

#include "proto/scene_spec.h"
#include "server/audit.h"

namespace tandem::server {

/// What the audit log says of it beside what happened and in which session: who, when, which number; of authority the tool, and each
/// seat's weight before and after.
[[nodiscard]] std::string audit_words(const AuditEvent& event, const SceneSpec& scene);

}  // namespace tandem::server
