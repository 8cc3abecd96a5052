#pragma once

#include <string>

#include "proto/spec/scene_spec.h"
#include "server/report/report.h"

namespace tandem::server {

/// A report as text: a table of seats and phases, links, contact, and violations. The caller prints a headline above
/// it.
[[nodiscard]] std::string report_summary(const RunReport& report, const SceneSpec& scene);

}  // namespace tandem::server
