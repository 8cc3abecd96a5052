#pragma once

#include <string>

#include "proto/scene_spec.h"
#include "server/report.h"

namespace tandem::netsim {

/// A finished run for people: the verdict in words, a table of seats, phases, what was broken.
[[nodiscard]] std::string run_summary(const server::RunReport& report, const SceneSpec& scene, const std::string& network);

}  // namespace tandem::netsim
