#pragma once

#include "netsim/world.h"
#include "server/report.h"

namespace tandem::netsim {

/// Link statistics of every seat, both directions, as the two ends counted them.
[[nodiscard]] std::vector<server::LinkReport> link_reports(const World& world);

/// Judges a finished world. `trace_hash` and `cpu_s` are the caller's.
[[nodiscard]] server::RunReport world_report(const World& world, const server::ReportBuilder& builder, std::uint64_t seed);

}  // namespace tandem::netsim
