#pragma once

#include <string>

#include "proto/scene_spec.h"
#include "server/report.h"

namespace tandem::server {

/// A report for people, below a headline of the caller's: a table of seats and phases, links, contact, what was broken.
[[nodiscard]] std::string report_summary(const RunReport& report, const SceneSpec& scene);

}  // namespace tandem::server
